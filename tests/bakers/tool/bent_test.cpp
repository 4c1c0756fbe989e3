// Bent normals from the bake to the numbers of the shader, on a tube.
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

using Names = std::vector<std::string>;
using Json = nlohmann::json;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A folder with a tube, its model, and the model with bent normals.
struct Bent {
  TestFolder folder;
  std::string glb = folder.path("hero.glb"), plain = folder.path("hero.nook"),
              bent = folder.path("bent.nook"), report = folder.path("r.json");

  Bent() {
    write_text(glb, glb_tube({"walk", "run", "jump", "sit"}));
    done({"bake",  "character",    glb,    "-o",           plain, "--preset",
          "draft", "--split",      "half", "--auto-poses", "30",  "--samples-per-clip",
          "4",     "--rays",       "16",   "--steps",      "100", "--spheres",
          "8",     "--key-points", "30"});
    bake(bent, {});
  }
  void done(Names arguments) const {
    arguments.push_back("--quiet");
    const ToolRun run = folder.run(arguments);
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
  }
  void bake(const std::string& output, const Names& more) const {
    Names arguments{"bake", "bent",         glb, plain,    "-o", output, "--report",
                    report, "--auto-poses", "8", "--rays", "64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    done(arguments);
  }
  Json rows() const { return Json::parse(read_text(report)).at("rows"); }
};

}  // namespace

TEST_CASE("bake bent adds six bytes for each vertex, the same on any number of threads") {
  const Bent tube;
  const Json row = tube.rows().at(0);
  CHECK(row.at("bent_bytes") == 6 * row.at("vertices").get<int>());
  CHECK(row.at("model_bytes") == read_text(tube.bent).size());
  tube.bake(tube.folder.path("again.nook"), {"--threads", "1"});
  CHECK(read_text(tube.folder.path("again.nook")) == read_text(tube.bent));
  for (const std::string* model : {&tube.plain, &tube.bent}) {
    tube.done({"inspect", *model, "--report", tube.report});
    CHECK(tube.rows().at(0).at("bent_normals") == (model == &tube.bent));
    CHECK((tube.rows().at(0).at("bytes_BENT") > 0) == (model == &tube.bent));
  }
}

TEST_CASE("evaluate bent measures a tube under uniform light and under a map") {
  const Bent tube;
  const std::string map = tube.folder.path("sky.hdr"), pictures = tube.folder.path("pictures");
  write_text(map, rgbe_map(32, 16));
  const auto rows = [&](const std::string& threads) {
    tube.done({"evaluate", "bent",      tube.glb,    tube.bent, "--maps",   map,      "--max-poses",   "4",
               "--points", "80",        "--rays",    "128",     "--images", pictures, "--image-count", "1",
               "--report", tube.report, "--threads", threads});
    return tube.rows();
  };
  const Json found = rows("1");
  CHECK(found == rows("2"));
  CHECK(read_text(pictures + "/glossy_0.png").substr(1, 3) == "PNG");
  REQUIRE(found.size() == 6);
  const char* const methods[] = {"normal", "nook", "reference"};
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].at("method") == methods[i % 3]);
    CHECK(found[i].at("map") == (i < 3 ? "visibility" : "sky"));
    CHECK(found[i].at("specular_mse_by_roughness").size() == 5);
    CHECK(found[i].at("poses") == 4);
  }
  CHECK(found[2].at("angle_median") == 0);
  // The form of AO alone takes no bent normal; the reference has its own AO.
  CHECK(found[1].at("lagarde_mse") == found[0].at("lagarde_mse"));
  CHECK(found[2].at("lagarde_mse") != found[0].at("lagarde_mse"));
}

TEST_CASE("evaluate bent and train bent refuse a model without bent normals") {
  const Bent tube;
  for (const char* command : {"evaluate", "train"}) {
    Names arguments{command, "bent", tube.glb, tube.plain, "--max-poses", "1"};
    if (std::string(command) == "train") arguments.insert(arguments.end(), {"-o", tube.folder.path("n.h")});
    const ToolRun run = tube.folder.run(arguments);
    CHECK(run.exit_code == 1);
    CHECK(has(run.error, "nook bake bent"));
  }
  const ToolRun no_map =
      tube.folder.run({"evaluate", "bent", tube.glb, tube.bent, "--images", tube.folder.path("pictures")});
  CHECK(no_map.exit_code == 2);
  CHECK(has(no_map.error, "--maps"));
}

TEST_CASE("train bent writes the numbers of the shader, which fit better than the form of AO alone") {
  const Bent tube;
  const auto train = [&](const std::string& output, const std::string& threads, const std::string& seed) {
    tube.done({"train", "bent", tube.glb, tube.bent, "-o", output, "--max-poses", "4", "--points", "150",
               "--steps", "3000", "--report", tube.report, "--threads", threads, "--seed", seed});
    return read_text(output);
  };
  const std::string header = train(tube.folder.path("1.h"), "1", "1");
  const Json row = tube.rows().at(0);
  CHECK(row.at("poses") == 4);
  CHECK(row.at("points").get<int>() > 300);
  CHECK(row.at("mse").get<double>() < row.at("mse_lagarde").get<double>());
  CHECK(header == train(tube.folder.path("2.h"), "2", "1"));
  CHECK(header != train(tube.folder.path("3.h"), "2", "2"));
  CHECK(has(header, "#ifndef NOOK_CHARACTER_SPECULAR_NUMBERS_H"));
  CHECK(has(header, "#define NOOK_SCENE_SPECULAR_13 "));
  CHECK(has(header, "#define NOOK_SCENE_SPECULAR_BIAS "));
}
