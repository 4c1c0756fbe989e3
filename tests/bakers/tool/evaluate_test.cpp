#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

using Names = std::vector<std::string>;
using Json = nlohmann::json;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A folder with a character of four clips and a model that was fitted to half of them.
struct Baked {
  TestFolder folder;
  std::string glb = folder.path("hero.glb"), model = folder.path("hero.nook"), report = folder.path("r.json");

  explicit Baked(const Names& more = {"--split", "half"}) {
    write_text(glb, glb_tube({"walk", "run", "jump", "sit"}));
    Names arguments{"bake",
                    "character",
                    glb,
                    "-o",
                    model,
                    "--preset",
                    "draft",
                    "--quiet",
                    "--auto-poses",
                    "30",
                    "--samples-per-clip",
                    "6",
                    "--rays",
                    "16",
                    "--steps",
                    "100",
                    "--spheres",
                    "8",
                    "--key-points",
                    "30"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolRun run = folder.run(arguments);
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
  }
  ToolRun evaluate(const Names& more = {}) const {
    Names arguments{"evaluate", "character", glb, model, "--report", report, "--rays", "64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return folder.run(arguments);
  }
  Json row() const { return Json::parse(read_text(report)).at("rows").at(0); }
  Json clips() const { return Json::parse(read_text(report)).at("clips"); }
};

}  // namespace

TEST_CASE("by default the clips that were not fitted are measured, 20 poses each") {
  const Baked baked;
  const ToolRun run = baked.evaluate();
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(baked.clips() == Names{"run", "walk"});  // jump and sit are first and third in byte order
  const Json row = baked.row();
  CHECK(row.at("poses") == 40);
  CHECK(row.at("protocol") == "unseen clips");
  for (const char* key : {"vertices",
                          "bones",
                          "spheres",
                          "key_points",
                          "model_bytes",
                          "poses",
                          "rays",
                          "noise_floor_mse",
                          "mse",
                          "rmse",
                          "mse_area",
                          "mse_body",
                          "mse_hands",
                          "mse_static",
                          "mse_area_static",
                          "mse_oracle",
                          "visible_share",
                          "mse_visible",
                          "mse_static_visible",
                          "mse_oracle_visible",
                          "ratio_to_oracle_visible",
                          "worst_clip",
                          "worst_clip_ratio_to_static_visible",
                          "worst_clip_over_body"}) {
    INFO(key);
    CHECK(row.contains(key));
    CHECK(has(run.out, key));
  }
  CHECK(row.at("mse").get<double>() > 0);
  // Exact sums by the runtime differ from the scalar reference by rounding, its default ones by far_error. AO
  // that is rounded by 1e-5 changes a squared error by 2e-5 times its root.
  const auto rounded = [&](const char* key) {
    const double mse = row.at(key).get<double>();
    return Approx(mse).epsilon(1e-3).margin(2e-5 * std::sqrt(mse));
  };
  CHECK(row.at("mse_update_exact").get<double>() == rounded("mse"));
  CHECK(row.at("mse_update_exact_visible").get<double>() == rounded("mse_visible"));
  CHECK(row.at("mse_update").get<double>() == Approx(row.at("mse").get<double>()).epsilon(0.02));
  CHECK(row.contains("mse_update_visible"));
  CHECK(row.at("mse_oracle").get<double>() <=
        row.at("mse_static").get<double>());  // the oracle is the best static bake
  CHECK(row.at("mse_oracle_visible").get<double>() <= row.at("mse_static_visible").get<double>());
  const double share = row.at("visible_share").get<double>();
  CHECK(share > 0);
  CHECK(share <= 1);
  // The parts that are left out add to the error over all.
  CHECK(share * row.at("mse_visible").get<double>() <= row.at("mse").get<double>() * (1 + 1e-12));
  CHECK(row.at("model_bytes") == read_text(baked.model).size());
  // The body's ratio is a mean over its clips, so that the worst clip cannot have a smaller ratio.
  const std::string worst = row.at("worst_clip").get<std::string>();
  CHECK((worst == "run" || worst == "walk"));
  CHECK(row.at("worst_clip_over_body").get<double>() >= 1 - 1e-12);
  CHECK(row.at("worst_clip_ratio_to_static_visible").get<double>() >=
        row.at("ratio_to_static_visible").get<double>() * (1 - 1e-9));
}

TEST_CASE("the worst clip is the one that is measured worst alone") {
  const Baked baked;
  REQUIRE(baked.evaluate({"--samples-per-clip", "4"}).exit_code == 0);
  const Json both = baked.row();
  double largest = 0;
  std::string name;
  for (const char* clip : {"run", "walk"}) {
    REQUIRE(baked.evaluate({"--samples-per-clip", "4", "--clips", clip}).exit_code == 0);
    CHECK(baked.row().at("worst_clip_over_body").get<double>() == 1);
    const double ratio = baked.row().at("ratio_to_static_visible").get<double>();
    if (ratio > largest) {
      largest = ratio;
      name = clip;
    }
  }
  CHECK(both.at("worst_clip") == name);
}

TEST_CASE("named clips, and all of them when all were fitted") {
  const Baked baked(Names{});
  REQUIRE(baked.evaluate({"--samples-per-clip", "3"}).exit_code == 0);
  CHECK(baked.clips() == Names{"jump", "run", "sit", "walk"});
  CHECK(baked.row().at("protocol") == "all clips");
  CHECK(baked.row().at("poses") == 12);
  REQUIRE(baked.evaluate({"--clips", "sit", "--samples-per-clip", "3"}).exit_code == 0);
  CHECK(baked.clips() == Names{"sit"});
  const ToolRun unknown = baked.evaluate({"--clips", "fly"});
  CHECK(unknown.exit_code == 2);
  CHECK(has(unknown.error, "no clip \"fly\"; the file has these:\n  jump\n  run\n  sit\n  walk"));
}

TEST_CASE("the training poses can be made again from the model's recipe") {
  const Baked baked;
  const ToolRun run = baked.evaluate({"--poses", "training"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(baked.row().at("poses") == 30 + 2 * 6 + 2 * 6);  // automatic, of two clips, variants of these
}

TEST_CASE("the same evaluation gives the same numbers on any number of threads") {
  const Baked baked;
  REQUIRE(baked.evaluate({"--threads", "1"}).exit_code == 0);
  const Json one = baked.row();
  REQUIRE(baked.evaluate({"--threads", "2"}).exit_code == 0);
  CHECK(baked.row() == one);
}

TEST_CASE("pictures of the error") {
  const Baked baked;
  const ToolRun run =
      baked.evaluate({"--images", baked.folder.path("pictures"), "--image-count", "2", "--quiet"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  for (const char* name : {"pictures/pose_0.png", "pictures/pose_1.png", "pictures/rms.png"})
    CHECK(read_text(baked.folder.path(name)).substr(1, 3) == "PNG");
}

TEST_CASE("a neighbour darkens less the farther it is, by each form and by ray tracing") {
  const Baked baked;
  const auto rows_with = [&](const char* threads) {
    const ToolRun run = baked.folder.run({"evaluate", "casters", baked.glb, baked.model, "--report",
                                          baked.report, "--rays", "64", "--bearings", "2", "--poses", "2",
                                          "--distances", "1,2,3,5,10", "--threads", threads});
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    CHECK(has(run.out, "darkening_traced"));
    return Json::parse(read_text(baked.report)).at("rows");
  };
  const Json rows = rows_with("1");
  CHECK(rows == rows_with("2"));
  REQUIRE(rows.size() == 10);  // five distances, two forms
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    const Json &composed = rows[i], &paper = rows[i + 1];
    CHECK(composed.at("form") == "composed");
    CHECK(paper.at("form") == "paper");
    CHECK(composed.at("darkening_traced") == paper.at("darkening_traced"));
    CHECK(composed.at("darkening").get<double>() > 0);
    if (i == 0) continue;
    CHECK(composed.at("distance_m") > rows[i - 2].at("distance_m"));
    for (const std::size_t form : {i, i + 1})
      CHECK(rows[form].at("darkening") < rows[form - 2].at("darkening"));
  }
  // Between 1 m and 10 m a body's solid angle falls by two orders of magnitude; rays resolve one of them.
  CHECK(rows[8].at("darkening_traced").get<double>() < 0.1 * rows[0].at("darkening_traced").get<double>());
  const double radius_m = rows[0].at("distance_m").get<double>() / rows[0].at("distance_radii").get<double>();
  REQUIRE(baked.folder
              .run({"evaluate", "casters", baked.glb, baked.model, "--report", baked.report, "--rays", "16",
                    "--bearings", "1", "--poses", "1", "--radii", "--distances", "2"})
              .exit_code == 0);
  const Json in_radii = Json::parse(read_text(baked.report)).at("rows")[0];
  CHECK(in_radii.at("distance_radii").get<double>() == Approx(2));  // float
  CHECK(in_radii.at("distance_m").get<double>() == Approx(2 * radius_m));
  // Two tubes across each other: parts of both lie inside the other one.
  const auto contact = [&](const char* clip) {
    return baked.folder.run({"evaluate", "casters", baked.glb, baked.model, "--report", baked.report,
                             "--rays", "64", "--contact", "walk", clip, "0", "0", "0.05", "90", "--images",
                             baked.folder.path("touch")});
  };
  REQUIRE(contact("run").exit_code == 0);
  const Json touching = Json::parse(read_text(baked.report)).at("rows");
  REQUIRE(touching.size() == 2);
  const double inside = touching[0].at("share_inside").get<double>();
  CHECK((inside > 0 && inside < 1));
  CHECK(read_text(baked.folder.path("touch/contact.png")).substr(1, 3) == "PNG");
  CHECK(contact("fly").exit_code == 2);
}

TEST_CASE("a model of another character is refused") {
  // Blocks instead of sections, because each section would bake the model again.
  const Baked baked;
  const std::string glb = read_text(baked.glb), model = read_text(baked.model);
  {
    INFO("other clips");
    write_text(baked.glb, glb_tube({"walk"}));
    const ToolRun run = baked.evaluate();
    write_text(baked.glb, glb);
    CHECK(run.exit_code == 3);
    CHECK(has(run.error, "hero.nook: the model was baked from a file with other clips"));
  }
  {
    INFO("a damaged model");
    std::string bytes = model;
    bytes[bytes.size() / 2] ^= 1;
    write_text(baked.model, bytes);
    const ToolRun run = baked.evaluate();
    write_text(baked.model, model);
    CHECK(run.exit_code == 3);
    CHECK(has(run.error, "hero.nook: "));
  }
  {
    INFO("no model");
    const ToolRun run =
        baked.folder.run({"evaluate", "character", baked.glb, baked.folder.path("none.nook")});
    CHECK(run.exit_code == 3);
    CHECK(has(run.error, "none.nook: cannot be read"));
  }
  {
    INFO("a report that cannot be written, before any ray is traced");
    const ToolRun run = baked.folder.run(
        {"evaluate", "casters", baked.glb, baked.model, "--report", baked.folder.path("no folder/r.json")});
    CHECK(run.exit_code != 0);
    CHECK(has(run.error, "no folder/r.json"));
    CHECK_FALSE(has(run.error, "ray tracing"));
  }
  CHECK(baked.folder.names() == Names{"hero.glb", "hero.nook"});  // no report of what failed
}

TEST_CASE("evaluate world has a row for each surface and method, and pictures") {
  const Baked baked;
  const std::string images = baked.folder.path("images");
  const ToolRun run =
      baked.folder.run({"evaluate", "world", baked.glb, baked.model, "--report", baked.report, "--max-poses",
                        "2", "--points", "40", "--rays", "16", "--images", images, "--image-count", "1"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json report = Json::parse(read_text(baked.report));
  CHECK(report.at("protocol") == "unseen clips");
  CHECK(report.at("casters").get<int>() > 0);
  // Four surfaces and three cones, five methods.
  REQUIRE(report.at("rows").size() == 35);
  for (const Json& row : report.at("rows")) {
    for (const char* key : {"surface", "method", "mse", "mse_none", "bias", "over_none", "over_none_low",
                            "over_none_high", "over_capsules", "poses", "rays"})
      CHECK(row.contains(key));
    CHECK(row.at("poses") == 2);
    if (row.at("surface") == "cone") CHECK(row.contains("cone_degrees"));
  }
  CHECK(!read_text(images + "/pose_0.png").empty());
  CHECK(baked.folder.run({"evaluate", "world", baked.glb}).exit_code == 2);
  CHECK(baked.folder.run({"evaluate", "world", baked.glb, baked.model, "--clips", "fly"}).exit_code == 2);
}

TEST_CASE("evaluate world --silhouettes compares outlines with ray tracing") {
  const Baked baked;
  const ToolRun run = baked.folder.run({"evaluate", "world", baked.glb, baked.model, "--report", baked.report,
                                        "--silhouettes", "--max-poses", "2"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json report = Json::parse(read_text(baked.report));
  REQUIRE(report.at("rows").size() == 2);
  for (const Json& row : report.at("rows")) {
    INFO(row.dump());
    CHECK(row.at("surface") == "silhouette");
    CHECK(row.at("poses") == 2);
    CHECK(row.at("shadows") == 16);
    // A tube is a capsule in each of its bones.
    if (row.at("method") == "nook") CHECK(row.at("iou").get<double>() > 0.8);
    CHECK(row.at("iou_low").get<double>() <= row.at("iou").get<double>());
    CHECK(row.at("iou").get<double>() <= 1);
  }
  CHECK(baked.folder.run({"evaluate", "world", baked.glb, baked.model, "--silhouettes", "--composite"})
            .exit_code == 2);
}

TEST_CASE("evaluate world --composite measures both passes in a room") {
  const Baked baked;
  const ToolRun run = baked.folder.run({"evaluate", "world", baked.glb, baked.model, "--report", baked.report,
                                        "--composite", "--views", "1", "--figures", "2", "--rays", "16"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json report = Json::parse(read_text(baked.report));
  double none = 0, nook = 0;
  for (const Json& row : report.at("rows")) {
    for (const char* key : {"surface", "scene", "region", "method", "mse", "over_screen", "bias", "pixels"})
      CHECK(row.contains(key));
    if (row.at("region") != "darkened") continue;
    if (row.at("method") == "none") none = row.at("mse");
    if (row.at("method") == "nook") nook = row.at("mse");
  }
  CHECK(none > 0);
  // The room alone is most of what darkens: any sound composition leaves much less.
  CHECK(nook < 0.5 * none);
  CHECK(baked.folder.run({"evaluate", "world", baked.glb, baked.model, "--composite", "--scene", baked.model})
            .exit_code == 3);
}

TEST_CASE("export casters writes each format with its error") {
  const Baked baked;
  for (const char* format : {"unreal", "source2", "gltf"}) {
    const std::string out = baked.folder.path("casters.txt");
    const ToolRun run = baked.folder.run(
        {"export", "casters", baked.model, "-o", out, "--format", format, "--report", baked.report});
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    const Json row = Json::parse(read_text(baked.report)).at("rows").at(0);
    CHECK(row.at("format") == format);
    CHECK(row.at("casters").get<int>() > 0);
    CHECK(row.at("over_none").get<double>() < 0.05);
    CHECK(read_text(out).size() > 1000);
  }
  CHECK(baked.folder.run({"export", "casters", baked.model}).exit_code == 2);
  CHECK(baked.folder.run({"export", "casters", baked.glb, "-o", baked.folder.path("x")}).exit_code == 3);
}

TEST_CASE("clips of a character bake, are measured, and are inspected") {
  const Baked baked;
  const std::string clips = baked.folder.path("clips.nook");
  const ToolRun bake = baked.folder.run({"bake", "clips", baked.glb, baked.model, "-o", clips, "--clips",
                                         "walk,jump", "--frames-per-second", "20", "--rays", "32",
                                         "--max-bytes", "2", "--report", baked.report, "--quiet"});
  INFO(bake.error);
  REQUIRE(bake.exit_code == 0);
  const Json made = baked.row();
  // Two clips of a second, both ends included.
  CHECK(made.at("frames") == 42);
  CHECK(made.at("modes").get<int>() % 4 == 0);
  CHECK(made.at("error").get<double>() < 0.05);

  const ToolRun measured =
      baked.folder.run({"evaluate", "clips", baked.glb, baked.model, clips, "--rays", "64", "--max-poses",
                        "10", "--pairs", "2", "--report", baked.report});
  INFO(measured.error);
  REQUIRE(measured.exit_code == 0);
  const Json report = Json::parse(read_text(baked.report));
  CHECK(report.at("file_bytes") == made.at("file_bytes"));
  const Json& rows = report.at("rows");
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].at("at") == "frames");
  CHECK(rows[1].at("at") == "half_way");
  CHECK(rows[3].at("distance_m").get<double>() == 1.5);
  // A draft of eight spheres is a rough model of the tube, and the clips are ray traced. Half way between two
  // frames the clips interpolate, and the model does not; 64 rays leave a few percent of noise in both.
  CHECK(rows[0].at("mse").get<double>() < rows[0].at("mse_live").get<double>());
  CHECK(rows[1].at("mse").get<double>() < 1.1 * rows[1].at("mse_live").get<double>());

  const ToolRun inspected = baked.folder.run({"inspect", clips});
  CHECK(inspected.exit_code == 0);
  CHECK(has(inspected.out, "clips"));
  CHECK(
      baked.folder.run({"bake", "clips", baked.glb, baked.model, "-o", clips, "--clips", "swim"}).exit_code ==
      2);
  CHECK(baked.folder.run({"evaluate", "clips", baked.glb, baked.model, baked.model}).exit_code == 3);
}
