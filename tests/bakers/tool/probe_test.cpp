// nook bake probe and nook evaluate probe as a user runs them.
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

using Json = nlohmann::json;

namespace {

Json rows_of(const TestFolder& folder, const std::string& report) {
  return Json::parse(read_text(folder.path(report))).at("rows");
}

}  // namespace

TEST_CASE("bake probe of a map: file, report, picture, and what inspect says of it") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  const ToolRun run = folder.run({"bake", "probe", folder.path("sky.hdr"), "-o", folder.path("sky.nook"),
                                  "--lobes", "9", "--constraint", "none", "--picture", folder.path("sky.png"),
                                  "--report", folder.path("r.json")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(folder.names() == std::vector<std::string>{"r.json", "sky.hdr", "sky.nook", "sky.png"});
  const Json row = rows_of(folder, "r.json").at(0);
  CHECK(row.at("floats") == 27);
  CHECK(row.at("excess_mse").get<double>() < 1e-3);  // texels' centres stand for texels of 11 degrees
  CHECK(std::abs(row.at("mean_ratio").get<double>() - 1) < 0.05);
  CHECK(read_text(folder.path("sky.png")).substr(1, 3) == "PNG");
  const ToolRun inspected = folder.run({"inspect", folder.path("sky.nook")});
  CHECK(inspected.exit_code == 0);
  CHECK(inspected.out.find("light probe") != std::string::npos);
  CHECK(inspected.out.find("sky.hdr") != std::string::npos);
}

TEST_CASE("bake probe: the same bytes on any number of threads, every method and basis") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  const auto bake = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{
        "bake", "probe", folder.path("sky.hdr"), "-o", folder.path(name), "--samples", "4096", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const ToolRun run = folder.run(words);
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.empty());
    return read_text(folder.path(name));
  };
  CHECK(bake("a.nook", {"--threads", "1"}) == bake("b.nook", {"--threads", "2"}));
  CHECK(bake("a.nook", {}) != bake("b.nook", {"--seed", "2"}));
  for (const char* method :
       {"naive", "running-average", "running-average-original", "running-average-non-negative", "moments",
        "least-squares", "non-negative-least-squares"})
    CHECK_FALSE(bake("a.nook", {"--method", method, "--ambient"}).empty());
  CHECK_FALSE(bake("a.nook", {"--basis", "harmonics", "--order", "1"}).empty());
  CHECK_FALSE(bake("a.nook", {"--basis", "dice", "--hemisphere", "--sampling", "uniform"}).empty());
  CHECK(bake("a.nook", {"--packing", "rgb9e5", "--method", "non-negative-least-squares"}).size() <
        bake("b.nook", {"--method", "non-negative-least-squares"}).size());
}

TEST_CASE("bake probe refuses bad arguments and bad maps by name, and leaves nothing behind") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  write_text(folder.path("text.hdr"), "not an image");
  write_text(folder.path("square.hdr"), rgbe_map(16, 16));
  const std::string out = folder.path("o.nook"), sky = folder.path("sky.hdr");
  CHECK(folder.run({"bake", "probe", sky}).exit_code == 2);
  CHECK(folder.run({"bake", "probe", sky, "-o", out, "--lobes", "0"}).exit_code == 2);
  CHECK(folder.run({"bake", "probe", sky, "-o", out, "--lobes", "64", "--ambient"}).exit_code == 2);
  CHECK(folder.run({"bake", "probe", sky, "-o", out, "--method", "guess"}).exit_code == 2);
  CHECK(folder.run({"bake", "probe", sky, "-o", out, "--grid", "2x2"}).exit_code == 2);
  CHECK(folder.run({"bake", "probe", sky, "-o", out, "--grid", "2x2x2"}).exit_code == 2);  // without a light
  for (const char* name : {"text.hdr", "square.hdr", "missing.hdr"}) {
    const ToolRun run = folder.run({"bake", "probe", folder.path(name), "-o", out});
    CHECK(run.exit_code == 3);
    CHECK(run.error.find(name) != std::string::npos);
  }
  const ToolRun no_scene = folder.run({"bake", "probe", sky, "-o", out, "--grid", "2x2x2", "--light", sky});
  CHECK(no_scene.exit_code == 3);
  CHECK(no_scene.error.find("sky.hdr") != std::string::npos);
  CHECK(folder.run({"bake", "probe", sky, "-o", folder.path("no/such/o.nook")}).exit_code == 1);
  CHECK(folder.names() == std::vector<std::string>{"sky.hdr", "square.hdr", "text.hdr"});
}

namespace {

// A map of one colour: mantissa 128 of `exponent`, which is radiance 2^(exponent - 129).
std::string even_map(unsigned char mantissa, unsigned char exponent) {
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n";
  for (int i = 0; i < 32 * 16; ++i)
    for (const unsigned char byte : {mantissa, mantissa, mantissa, exponent}) file.push_back(char(byte));
  return file;
}

bool has_no_number_for(const std::string& text) {
  return !std::regex_search(text, std::regex("\\b(nan|inf)\\b"));
}

}  // namespace

TEST_CASE("a black map is fitted and measured, and ratios to its light are not numbers") {
  const TestFolder folder;
  write_text(folder.path("black.hdr"), even_map(0, 0));
  const ToolRun run = folder.run({"bake", "probe", folder.path("black.hdr"), "-o", folder.path("b.nook"),
                                  "--picture", folder.path("b.png"), "--report", folder.path("r.json")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(has_no_number_for(run.out));
  const Json row = rows_of(folder, "r.json").at(0);
  CHECK(row.at("irradiance_rms") == 0);
  for (const char* ratio : {"irradiance_relative", "excess_mse", "mean_ratio", "irradiance_minimum"})
    CHECK(row.at(ratio).is_null());
  const ToolRun measured =
      folder.run({"evaluate", "probe", folder.path("black.hdr"), folder.path("b.nook"), "--seeds", "1",
                  "--rotations", "1", "--report", folder.path("e.json")});
  INFO(measured.out);
  REQUIRE(measured.exit_code == 0);
  CHECK(has_no_number_for(measured.out));
  for (const Json& of_method : rows_of(folder, "e.json")) {
    if (of_method.contains("roughness")) continue;  // a row of gloss
    CHECK(of_method.at("irradiance_rms") == 0);
    CHECK(of_method.at("mean").is_null());
  }
  write_text(folder.path("tube.glb"), glb_tube({}, false));
  REQUIRE(folder
              .run({"bake", "probe", folder.path("tube.glb"), "-o", folder.path("g.nook"), "--grid", "2x1x1",
                    "--light", folder.path("black.hdr"), "--samples", "128", "--quiet"})
              .exit_code == 0);
  const ToolRun grid =
      folder.run({"evaluate", "probe", folder.path("g.nook"), "--scene", folder.path("tube.glb"), "--light",
                  folder.path("black.hdr"), "--points", "16", "--paths", "4"});
  INFO(grid.out);
  REQUIRE(grid.exit_code == 0);
  CHECK(has_no_number_for(grid.out));
}

TEST_CASE("light that has no sums is refused at the entry, light just below it is fitted") {
  const TestFolder folder;
  write_text(folder.path("bright.hdr"), even_map(128, 255));  // 8.5e37
  write_text(folder.path("most.hdr"), even_map(128, 177));    // 2.8e14
  const std::string out = folder.path("o.nook");
  write_text(folder.path("tube.glb"), glb_tube({}, false));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"bake", "probe", folder.path("bright.hdr"), "-o", out},
        {"bake", "probe", folder.path("tube.glb"), "-o", out, "--grid", "2x1x1", "--light",
         folder.path("bright.hdr")},
        {"evaluate", "probe", folder.path("bright.hdr")}}) {
    const ToolRun run = folder.run(words);
    CHECK(run.exit_code == 3);
    CHECK(run.error.find("bright.hdr") != std::string::npos);
    CHECK(run.error.find("above 1e+15") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(out));
  const ToolRun run = folder.run({"bake", "probe", folder.path("most.hdr"), "-o", out});
  INFO(run.out << run.error);
  CHECK(run.exit_code == 0);
  CHECK(has_no_number_for(run.out));
}

TEST_CASE("bake probe of a scene: a grid, refined until its error is small") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  write_text(folder.path("tube.glb"), glb_tube({}, false));
  const auto bake = [&](const std::string& name, const std::string& threads) {
    return folder.run({"bake", "probe", folder.path("tube.glb"), "-o", folder.path(name), "--grid", "3x2x2",
                       "--light", folder.path("sky.hdr"), "--box", "-1,0.5,-1,1,2,1", "--error", "0.1",
                       "--threads", threads, "--report", folder.path("r.json")});
  };
  const ToolRun run = bake("a.nook", "1");
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json row = rows_of(folder, "r.json").at(0);
  CHECK(row.at("probes") == 12);
  CHECK(row.at("error").get<double>() <= 0.1);
  CHECK(row.at("error").get<double>() > 0.02);  // it stopped there, and not at the last sample
  REQUIRE(bake("b.nook", "2").exit_code == 0);
  CHECK(read_text(folder.path("a.nook")) == read_text(folder.path("b.nook")));
  const ToolRun inspected = folder.run({"inspect", folder.path("a.nook")});
  CHECK(inspected.out.find("[3,2,2]") != std::string::npos);
  const ToolRun measured =
      folder.run({"evaluate", "probe", folder.path("sky.hdr"), folder.path("a.nook"), "--seeds", "1"});
  CHECK(measured.exit_code == 3);
  CHECK(measured.error.find("a grid of 12 probes") != std::string::npos);
}

TEST_CASE("evaluate probe measures a grid against path tracing of its scene") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  write_text(folder.path("tube.glb"), glb_tube({}, false));
  const std::string grid = folder.path("g.nook");
  REQUIRE(folder
              .run({"bake", "probe", folder.path("tube.glb"), "-o", grid, "--grid", "2x2x2", "--light",
                    folder.path("sky.hdr"), "--box", "-1,-1,-1,1,2,1", "--error", "0.05", "--quiet"})
              .exit_code == 0);
  const auto evaluate = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"evaluate", "probe", grid,       "--points",           "64",
                                   "--paths",  "128",   "--report", folder.path("r.json")};
    words.insert(words.end(), more.begin(), more.end());
    return folder.run(words);
  };
  const ToolRun run = evaluate({"--scene", folder.path("tube.glb"), "--light", folder.path("sky.hdr")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json rows = rows_of(folder, "r.json");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("places") == "on surfaces");
  CHECK(rows[2].at("places") == "in the open");
  for (const Json& row : rows) {
    CHECK(row.at("probes") == 8);
    CHECK(row.at("points") == 64);
    // An open sky that a thin tube hardly hides; the surface of the tube shades itself.
    CHECK(row.at("irradiance_rms_relative").get<double>() < 0.5);
    CHECK(row.at("irradiance_worst_relative").get<double>() >
          row.at("irradiance_rms_relative").get<double>());
  }
  // Grids measure what they were baked with: here reflected light alone, which is weak under an open sky.
  REQUIRE(folder
              .run({"bake", "probe", folder.path("tube.glb"), "-o", grid, "--grid", "2x2x2", "--light",
                    folder.path("sky.hdr"), "--box", "-1,-1,-1,1,2,1", "--error", "0.05", "--direct", "none",
                    "--report", folder.path("b.json")})
              .exit_code == 0);
  CHECK(rows_of(folder, "b.json").at(0).at("direct") == "none");
  CHECK(rows_of(folder, "b.json").at(0).at("suns").is_array());
  REQUIRE(evaluate({"--scene", folder.path("tube.glb"), "--light", folder.path("sky.hdr")}).exit_code == 0);
  const Json reflected = rows_of(folder, "r.json");
  CHECK(reflected.at(2).at("direct") == "none");
  CHECK(reflected.at(2).at("irradiance_mean").get<double>() <
        0.3 * rows.at(2).at("irradiance_mean").get<double>());
  CHECK(std::abs(reflected.at(2).at("irradiance_bias_relative").get<double>()) < 0.5);
  REQUIRE(evaluate({"--scene", folder.path("tube.glb"), "--light", folder.path("sky.hdr"), "--direct", "all"})
              .exit_code == 0);
  CHECK(rows_of(folder, "r.json").at(2).at("irradiance_bias_relative").get<double>() < -0.5);
  CHECK(evaluate({"--scene", folder.path("tube.glb"), "--light", folder.path("sky.hdr"), "--direct", "some"})
            .exit_code == 2);
  CHECK(evaluate({"--scene", folder.path("tube.glb")}).exit_code == 2);
  CHECK(evaluate({"--scene", folder.path("none.glb"), "--light", folder.path("sky.hdr")}).exit_code == 3);
}

TEST_CASE("a grid writes previews, and a signal leaves the latest one or nothing") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  write_text(folder.path("tube.glb"), glb_tube({}, false));
  std::vector<std::string> words{"bake",
                                 "probe",
                                 folder.path("tube.glb"),
                                 "-o",
                                 folder.path("g.nook"),
                                 "--grid",
                                 "8x4x8",
                                 "--light",
                                 folder.path("sky.hdr"),
                                 "--box",
                                 "-1,0.5,-1,1,2,1",
                                 "--error",
                                 "0",
                                 "--samples",
                                 "100000000"};
  const ToolRun stopped = folder.run_and_signal(words, SIGINT, "path tracing");
  CHECK(stopped.exit_code == 1);
  CHECK(stopped.error.find("nothing was written") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"sky.hdr", "tube.glb"});
  words.insert(words.end(), {"--preview-every", "0.05"});
  const ToolRun previewed = folder.run_and_signal(words, SIGINT, "preview");
  CHECK(previewed.exit_code == 1);
  CHECK(folder.names() == std::vector<std::string>{"g.nook", "sky.hdr", "tube.glb"});
  CHECK(folder.run({"inspect", folder.path("g.nook")}).exit_code == 0);
}

TEST_CASE("evaluate probe measures the fit of a bake, and baked probes") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  REQUIRE(folder
              .run({"bake", "probe", folder.path("sky.hdr"), "-o", folder.path("sky.nook"), "--method",
                    "least-squares"})
              .exit_code == 0);
  const ToolRun run =
      folder.run({"evaluate", "probe", folder.path("sky.hdr"), folder.path("sky.nook"), "--seeds", "2",
                  "--report", folder.path("r.json"), "--images", folder.path("images")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(std::filesystem::exists(folder.path("images/sky.png")));
  const Json rows = rows_of(folder, "r.json");
  double batch = 0, baked = 0;
  for (const Json& row : rows) {
    if (row.at("domain") == "sphere" && row.at("method") == "least_squares, bands")
      batch = row.at("radiance_rms");
    if (row.at("method") == "sky.nook") baked = row.at("radiance_rms");
  }
  CHECK(batch > 0);
  CHECK(std::abs(baked / batch - 1) < 1e-6);
  // Two methods over the sphere and the hemisphere, and the file; gloss of three kinds of amplitudes at four
  // values of roughness and at all of them.
  CHECK(rows.size() == 5 + 3 * 5);
  CHECK(folder.run({"evaluate", "probe", folder.path("sky.nook"), "--seeds", "1"}).exit_code == 2);
}
