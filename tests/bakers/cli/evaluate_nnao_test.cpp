// nook evaluate nnao as a user runs it, on the built-in scene and on files.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "tool_run.h"

namespace {

std::vector<std::string> tiny(std::vector<std::string> scene, const TestFolder& folder) {
  std::vector<std::string> arguments{"evaluate", "nnao"};
  arguments.insert(arguments.end(), scene.begin(), scene.end());
  for (const char* word : {"--size", "64x48", "--rays", "16", "--report"}) arguments.push_back(word);
  arguments.push_back(folder.path("r.json"));
  return arguments;
}

}  // namespace

TEST_CASE("evaluate nnao measures every method on the thin scene and draws a sheet") {
  const TestFolder folder;
  auto arguments = tiny({"--thin", "--camera=0.6,1.1,1.6,0.2,0.4,-0.7,55"}, folder);
  arguments.insert(arguments.end(), {"--images", folder.path("sheets")});
  const ToolRun run = folder.run(arguments);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.find("gtao_bitmask") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"r.json", "sheets"});
  CHECK(read_text(folder.path("sheets/thin_0.png")).substr(1, 3) == "PNG");
  const auto report = nlohmann::json::parse(read_text(folder.path("r.json")));
  CHECK(report.at("noise_floor_mse") > 0);
  REQUIRE(report.at("rows").size() == 2 * (5 + 3 + 3 + 3 + 6 + 6));
  for (const auto& row : report.at("rows"))
    for (const char* key : {"method", "taps", "blurred", "scene", "resolution", "gpu", "mse", "rmse", "ssim",
                            "r", "flicker", "fetches", "ms", "ratio_to_nnao"})
      CHECK(row.contains(key));
  CHECK(report.at("rows").at(0).at("resolution") == "64x48");
}

TEST_CASE("evaluate nnao refuses bad arguments and bad scenes, and leaves no half file") {
  const TestFolder folder;
  CHECK(folder.run({"evaluate", "nnao"}).exit_code == 2);
  CHECK(folder.run({"evaluate", "nnao", "--thin", "--tune", "all"}).exit_code == 2);
  CHECK(folder.run({"evaluate", "nnao", "--tune", "other"}).exit_code == 2);
  CHECK(folder.run({"evaluate", "nnao", "--thin", "--radius", "-1"}).exit_code == 2);
  for (const char* size : {"0x10", "640", "640x360x3", "99999x16"})
    CHECK(folder.run({"evaluate", "nnao", "--thin", "--size", size}).exit_code == 2);
  for (const char* camera :
       {"1,2,3", "0,0,0,0,0,0,60", "0,0,1,0,0,0,0", "nan,0,1,0,0,0,60", "0,0,1,0,0,0,60,1"})
    CHECK(folder.run({"evaluate", "nnao", "--thin", std::string("--camera=") + camera}).exit_code == 2);
  CHECK(folder.run(tiny({folder.path("none.glb")}, folder)).exit_code == 3);
  write_text(folder.path("bad.glb"), "glTF nonsense");
  const ToolRun run = folder.run(tiny({folder.path("bad.glb")}, folder));
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("bad.glb") != std::string::npos);
  write_text(folder.path("bad.nook"), "not a network");
  auto arguments = tiny({"--thin", "--cameras", "1"}, folder);
  arguments.insert(arguments.end(), {"--network", folder.path("bad.nook")});
  CHECK(folder.run(arguments).exit_code == 3);
  CHECK(folder.names() == std::vector<std::string>{"bad.glb", "bad.nook"});
}
