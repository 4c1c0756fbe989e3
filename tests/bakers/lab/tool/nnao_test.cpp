// nook-lab evaluate nnao as a user runs it, on the built-in scene and on files.
#include <signal.h>

#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

ToolRun lab(const TestFolder& folder, const std::vector<std::string>& words) {
  return folder.run_program(NOOK_LAB_TOOL, words);
}

std::vector<std::string> tiny(std::vector<std::string> scene, const TestFolder& folder) {
  std::vector<std::string> arguments{"evaluate", "nnao"};
  arguments.insert(arguments.end(), scene.begin(), scene.end());
  for (const char* word : {"--size", "64x48", "--rays", "16", "--report"}) arguments.push_back(word);
  arguments.push_back(folder.path("r.json"));
  return arguments;
}

// A floor of 4 m x 4 m and a wall along one side: 6 positions, 12 indices.
const std::string corner_gltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-2,0,-2],"max":[2,2,2]},)"
    R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
    R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":24}],)"
    R"("buffers":[{"byteLength":96,"uri":"data:application/octet-stream;base64,)"
    "AAAAwAAAAAAAAADAAAAAQAAAAAAAAADAAAAAQAAAAAAAAABAAAAAwAAAAAAAAABAAAAAwAAAAEAAAADAAAAAQAAAAE"
    "AAAADAAAACAAEAAAADAAIAAAABAAUAAAAFAAQA"
    R"("}]})";

}  // namespace

TEST_CASE("evaluate nnao measures every method on the thin scene and draws a sheet") {
  const TestFolder folder;
  auto arguments = tiny({"--thin", "--camera=0.6,1.1,1.6,0.2,0.4,-0.7,55"}, folder);
  arguments.insert(arguments.end(), {"--images", folder.path("sheets")});
  const ToolRun run = lab(folder, arguments);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.find("gtao_bitmask") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"r.json", "sheets"});
  for (const char* picture :
       {"thin_0", "thin_0_pairs", "thin_0_presets", "nnao_filters", "thin_0_nnao_units"})
    CHECK(read_text(folder.path("sheets/" + std::string(picture) + ".png")).substr(1, 3) == "PNG");
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(report.at("scenes").at(0).at("noise_floor_mse") > 0);
  REQUIRE(report.at("rows").size() == 2 * (6 + 4 + 3 + 3 + 3 + 6 + 6 + 3 + 6 + 8));
  for (const auto& row : report.at("rows"))
    for (const char* key :
         {"method", "taps", "blurred", "scene", "resolution", "gpu", "mse", "rmse", "ssim", "r", "dark_bias",
          "calibration", "border_bias", "flicker", "fetches", "ms", "ratio_to_nnao", "denoiser"})
      CHECK(row.contains(key));
  CHECK(report.at("rows").at(0).at("resolution") == "64x48");
  REQUIRE(report.at("borders").size() == 6 + 4 + 3 + 3 + 3 + 6 + 6 + 3 + 6 + 8);
  for (const char* border : {"left", "right", "bottom", "top"})
    CHECK(report.at("borders").at(0).at(border).size() == 3);
}

TEST_CASE("evaluate nnao tells of several scenes each and their mean, with another network beside") {
  const TestFolder folder;
  write_text(folder.path("corner.gltf"), corner_gltf);
  write_text(folder.path("other.gltf"), corner_gltf);
  REQUIRE(folder
              .run({"train", "nnao", "--form", "paper", "-o", folder.path("paper.nook"), "--scenes", "48",
                    "--views", "48", "--points", "16", "--rays", "4", "--epochs", "1"})
              .exit_code == 0);
  auto arguments = tiny({folder.path("corner.gltf"), folder.path("other.gltf"), "--thin",
                         "--camera=thin:0.6,1.1,1.6,0.2,0.4,-0.7,55", "--camera=corner:0,1.5,1.5,0,0,-2,60",
                         "--camera=other:0.5,1.5,1.5,0,0,-2,50", "--radius=corner:0.8"},
                        folder);
  arguments.insert(arguments.end(),
                   {"--markdown", folder.path("t.md"), "--network", folder.path("paper.nook"), "--ratio",
                    "nnao:16,gtao:16", "--methods", "nnao:16,nnao:64,nnao_paper:64,gtao:16"});
  const ToolRun run = lab(folder, arguments);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  const auto& rows = report.at("rows");
  const std::size_t methods = 2 * 4;
  REQUIRE(rows.size() == 4 * methods);
  for (std::size_t i = 0; i < methods; ++i) {
    const auto &corner = rows.at(i), &other = rows.at(methods + i), &thin = rows.at(2 * methods + i),
               &mean = rows.at(3 * methods + i);
    CHECK(corner.at("scene") == "corner");
    CHECK(other.at("scene") == "other");
    CHECK(thin.at("scene") == "thin");
    CHECK(mean.at("scene") == "mean");
    CHECK(mean.at("method") == corner.at("method"));
    // The built-in scene enters no mean.
    const double sum = corner.at("mse").get<double>() + other.at("mse").get<double>();
    CHECK(std::abs(mean.at("mse").get<double>() - sum / 2) < 1e-12);
  }
  CHECK(rows.at(4).at("method") == "nnao_paper");
  CHECK(std::abs(report.at("scenes").at(0).at("radius").get<double>() - 0.8) < 1e-6);
  CHECK(std::abs(report.at("scenes").at(1).at("radius").get<double>() - 0.5) < 1e-6);
  REQUIRE(report.at("ratios").size() == 1);
  const auto& ratio = report.at("ratios").at(0);
  CHECK(ratio.at("views") == 2);
  const auto mse = [&](std::size_t view, const char* method, int taps) {
    for (const auto& row : report.at("views"))
      if (row.at("view") == view && row.at("method") == method && row.at("taps") == taps && row.at("blurred"))
        return row.at("mse").get<double>();
    return 0.0;
  };
  const double expected =
      std::sqrt(mse(0, "nnao", 16) / mse(0, "gtao", 16) * mse(1, "nnao", 16) / mse(1, "gtao", 16));
  CHECK(std::abs(ratio.at("ratio").get<double>() / expected - 1) < 1e-6);
  const std::string markdown = read_text(folder.path("t.md"));
  CHECK(markdown.find("| method | taps | corner | other | thin | mean |\n") == 0);
  CHECK(markdown.find("| nnao | 64 | no |") != std::string::npos);
  CHECK(markdown.find("| nnao 16 | gtao 16 |") != std::string::npos);
}

TEST_CASE("evaluate nnao that is killed keeps its references, and goes on to the same numbers") {
  namespace fs = std::filesystem;
  const TestFolder folder;
  write_text(folder.path("corner.glb"), corner_gltf);
  const int count = 12;
  nlohmann::json cameras = nlohmann::json::array();
  for (int i = 0; i < count; ++i)
    cameras.push_back({{"name", "c" + std::to_string(i)},
                       {"eye", {0.1 * i, 1.5, 1.5}},
                       {"target", {0, 0, -2}},
                       {"fov", 60}});
  const nlohmann::json scene = {{"name", "corner"}, {"radius", 0.5}, {"cameras", cameras}};
  const nlohmann::json source = {{"name", "A"}, {"scenes", {scene}}};
  write_text(folder.path("views.json"),
             nlohmann::json{{"size", "96x72"}, {"rays", 1024}, {"sources", {source}}}.dump());
  const auto command = [&](const char* references) {
    return std::vector<std::string>{
        "evaluate",           "nnao",          "--views",      folder.path("views.json"),
        "--folder",           folder.path(""), "--references", folder.path(references),
        "--methods",          "nnao:16",       "--no-raw",     "--report",
        folder.path("r.json")};
  };
  const auto kept = [&] {
    std::map<std::string, fs::file_time_type> times;
    if (fs::exists(folder.path("kept")))
      for (const fs::directory_entry& entry : fs::directory_iterator(folder.path("kept")))
        if (entry.path().extension() == ".truth") times[entry.path()] = entry.last_write_time();
    return times;
  };
  const auto report_of_run = [&](const char* references) {
    const ToolRun run = lab(folder, command(references));
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    return nlohmann::json::parse(read_text(folder.path("r.json"))).at("views");
  };

  // A farm kills without a warning, and starts the same command again.
  const int child = folder.start_program(NOOK_LAB_TOOL, command("kept"));
  const auto began = std::chrono::steady_clock::now();
  while (kept().size() < 2 && std::chrono::steady_clock::now() - began < std::chrono::minutes(5))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, SIGKILL);
  REQUIRE(folder.finish(child).exit_code == 128 + SIGKILL);
  const auto before = kept();
  REQUIRE(before.size() >= 2);
  REQUIRE(before.size() < count);
  CHECK_FALSE(fs::exists(folder.path("r.json")));

  const nlohmann::json resumed = report_of_run("kept");
  const auto after = kept();
  CHECK(after.size() == count);
  for (const auto& [file, time] : before) CHECK(after.at(file) == time);
  const nlohmann::json whole = report_of_run("other");
  REQUIRE(resumed.size() == count);
  for (std::size_t i = 0; i < count; ++i) CHECK(resumed.at(i).at("mse") == whole.at(i).at("mse"));
}

TEST_CASE("evaluate nnao measures a list of views by source and keeps their references") {
  const TestFolder folder;
  write_text(folder.path("corner.glb"), corner_gltf);  // the importer goes by the content
  const std::string views =
      R"({"size": "64x48", "rays": 16, "ratios": ["nnao:16,nnao:32", "nnao:16,hbao:16"], "sources": [)"
      R"({"name": "A", "scenes": [{"name": "corner", "radius": 0.5, "cameras": [)"
      R"({"name": "far", "eye": [0, 1.5, 1.5], "target": [0, 0, -2], "fov": 60},)"
      R"({"name": "near", "eye": [0, 0.5, 0], "target": [0, 0, -2], "fov": 60, "radius": 0.25}]}]}]})";
  write_text(folder.path("views.json"), views);
  const std::vector<std::string> arguments{"evaluate",
                                           "nnao",
                                           "--views",
                                           folder.path("views.json"),
                                           "--folder",
                                           folder.path(""),
                                           "--references",
                                           folder.path("kept"),
                                           "--methods",
                                           "nnao:16,nnao:32",
                                           "--no-raw",
                                           "--report",
                                           folder.path("r.json")};
  const ToolRun run = lab(folder, arguments);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  REQUIRE(report.at("rows").size() == 2);
  CHECK(report.at("rows").at(0).at("scene") == "A");
  CHECK(report.at("rows").at(0).at("resolution") == "64x48");
  CHECK(report.at("rays") == 16);
  REQUIRE(report.at("views").size() == 4);
  CHECK(report.at("views").at(2).at("camera") == "near");
  CHECK(report.at("views").at(2).at("radius") == 0.25);
  // hbao is not measured.
  REQUIRE(report.at("ratios").size() == 1);
  CHECK(report.at("ratios").at(0).at("sources").at("A") > 0);
  REQUIRE(lab(folder, arguments).exit_code == 0);
  const auto again = nlohmann::json::parse(read_text(folder.path("r.json")));
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(again.at("views").at(i).at("mse") == report.at("views").at(i).at("mse"));

  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{R"("fov": 60)", R"("fov": 0)"},
                                                        {R"("radius": 0.5)", R"("radius": 0)"},
                                                        {R"("name": "corner")", R"("name": "../corner")"},
                                                        {R"([0, 1.5, 1.5])", R"([0, 1.5])"},
                                                        {R"("nnao:16,nnao:32")", R"("nnao,nnao:32")"},
                                                        {R"("sources": [)", R"("sources": )"}}) {
    std::string bad = views;
    REQUIRE(bad.find(from) != std::string::npos);
    bad.replace(bad.find(from), from.size(), to);
    write_text(folder.path("bad.json"), bad);
    const ToolRun refused =
        lab(folder, {"evaluate", "nnao", "--views", folder.path("bad.json"), "--folder", folder.path("")});
    INFO(to << ": " << refused.error);
    CHECK(refused.exit_code == 3);
    CHECK(refused.error.find("bad.json") != std::string::npos);
  }
  CHECK(lab(folder, {"evaluate", "nnao", "--views", folder.path("views.json"), folder.path("corner.glb")})
            .exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "--views", folder.path("views.json"), "--sources", "B"}).exit_code ==
        2);
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--ratio", "nnao:16"}).exit_code == 2);
}

TEST_CASE("evaluate nnao measures chosen methods alone") {
  const TestFolder folder;
  auto arguments = tiny({"--thin", "--cameras", "1", "--methods", "nnao,hbao"}, folder);
  REQUIRE(lab(folder, arguments).exit_code == 0);
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  REQUIRE(report.at("rows").size() == 2 * (6 + 3));
  for (const auto& row : report.at("rows")) CHECK((row.at("method") == "nnao" || row.at("method") == "hbao"));
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--methods", "other"}).exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--temporal", "--intensity", "1.03"}).exit_code == 2);
  // Without intensity AO is 1 after the filter, which leaves 0.65 or more where the reference is below 0.35.
  arguments = tiny({"--thin", "--cameras", "1", "--methods", "nnao:9", "--intensity", "0"}, folder);
  REQUIRE(lab(folder, arguments).exit_code == 0);
  const auto open = nlohmann::json::parse(read_text(folder.path("r.json")));
  for (const auto& row : open.at("rows"))
    if (row.at("blurred")) CHECK(row.at("dark_bias") >= 0.65);
  // No file, no method of that name.
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--methods", "nnao_paper"}).exit_code == 2);
}

TEST_CASE("evaluate nnao measures a character by its clip of walking") {
  const TestFolder folder;
  write_text(folder.path("tube.glb"), glb_tube({"bend", "Walk_Loop"}));
  write_text(folder.path("other.glb"), glb_tube({}));
  auto arguments = tiny({"--temporal", "--mover", folder.path("tube.glb")}, folder);
  arguments.insert(arguments.end(), {"--markdown", folder.path("m.md"), "--images", folder.path("sheets")});
  const ToolRun run = lab(folder, arguments);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(report.at("clips").at("tube") == "Walk_Loop");
  CHECK(report.at("rows").size() == 2 * 9);
  // Four shots, each with two cameras.
  REQUIRE(report.at("views").size() == 8 * 9);
  CHECK(report.at("views").at(0).at("mover_pixels") > 0);
  CHECK(read_text(folder.path("m.md")).find("| 9 | 8 frames, motion vectors |") != std::string::npos);
  CHECK(read_text(folder.path("sheets/tube_whole_moving.png")).substr(1, 3) == "PNG");

  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--mover", folder.path("tube.glb")},
           {"--temporal", "--thin", "--mover", folder.path("tube.glb")},
           {"--temporal", "--mover", folder.path("tube.glb"), "--mover", folder.path("tube.glb")},
           {"--temporal", "--thin", "--clip", "bend"},
           {"--temporal", "--mover", folder.path("tube.glb"), "--radius", "1"}}) {
    INFO(words.back());
    CHECK(lab(folder, tiny(words, folder)).exit_code == 2);
  }
  const ToolRun without = lab(folder, tiny({"--temporal", "--mover", folder.path("other.glb")}, folder));
  CHECK(without.exit_code == 3);
  CHECK(without.error.find("other.glb") != std::string::npos);
  CHECK(lab(folder, tiny({"--temporal", "--mover", folder.path("tube.glb"), "--clip", "Run"}, folder))
            .error.find("Walk_Loop") != std::string::npos);
}

TEST_CASE("evaluate nnao refuses bad arguments and bad scenes, and leaves no half file") {
  const TestFolder folder;
  CHECK(lab(folder, {"evaluate", "nnao"}).exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--tune", "all"}).exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "--tune", "other"}).exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--radius", "-1"}).exit_code == 2);
  for (const char* size : {"0x10", "640", "640x360x3", "99999x16"})
    CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--size", size}).exit_code == 2);
  for (const char* camera :
       {"1,2,3", "0,0,0,0,0,0,60", "0,0,1,0,0,0,0", "nan,0,1,0,0,0,60", "0,0,1,0,0,0,60,1"})
    CHECK(lab(folder, {"evaluate", "nnao", "--thin", std::string("--camera=") + camera}).exit_code == 2);
  for (const char* word :
       {"--camera=other:0,0,1,0,0,0,60", "--radius=other:1", "--radius=thin:0", "--radius=1m"})
    CHECK(lab(folder, {"evaluate", "nnao", "--thin", word}).exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "a/room.glb", "b/room.glb"}).exit_code == 2);
  // Methods of recorded frames, and frames beside scenes.
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--methods", "fast"}).exit_code == 2);
  CHECK(lab(folder, {"evaluate", "nnao", "--thin", "--frame", "frame.nook"}).exit_code == 2);
  CHECK(lab(folder, tiny({folder.path("none.glb")}, folder)).exit_code == 3);
  write_text(folder.path("bad.glb"), "glTF nonsense");
  const ToolRun run = lab(folder, tiny({folder.path("bad.glb")}, folder));
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("bad.glb") != std::string::npos);
  write_text(folder.path("bad.nook"), "not a network");
  auto arguments = tiny({"--thin", "--cameras", "1"}, folder);
  arguments.insert(arguments.end(), {"--network", folder.path("bad.nook")});
  CHECK(lab(folder, arguments).exit_code == 3);
  CHECK(folder.names() == std::vector<std::string>{"bad.glb", "bad.nook"});
}

TEST_CASE("evaluate nnao refuses to write two things into one file") {
  const TestFolder folder;
  const std::string a = folder.path("a"), b = folder.path("b"), again = folder.path("./b");
  for (const std::string& path : {a, b}) write_text(path, "kept");
  std::filesystem::create_directory(folder.path("images"));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--thin", "--markdown", b, "--report", again},
           {a, "--report", a},
           {a, "--network", b, "--markdown", b},
           {"--thin", "--images", folder.path("images"), "--report", folder.path("images/thin_0.png")}}) {
    std::vector<std::string> arguments{"evaluate", "nnao"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const ToolRun run = lab(folder, arguments);
    INFO(run.error);
    CHECK(run.exit_code == 2);
    CHECK(run.error.starts_with("nook-lab: "));
  }
  for (const std::string& path : {a, b}) CHECK(read_text(path) == "kept");
}
