// nook bake transfer and nook evaluate transfer as a user runs them.
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

using Json = nlohmann::json;
namespace shapes = nook::transfer::test;

namespace {

void write_shape(const std::string& path, const shapes::Shape& shape) {
  const std::vector<std::byte> bytes = shapes::glb_of(shape);
  write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

shapes::Shape ball_over_plane() {
  shapes::Shape shape = shapes::plane(1, 8, 2);
  shapes::append(shape, shapes::ball({0, 0.25f, 0}, 0.2f, 24));
  return shape;
}

}  // namespace

TEST_CASE("bake and evaluate transfer: files, reports, pictures, and better errors than simpler forms") {
  const TestFolder folder;
  write_shape(folder.path("ball.glb"), ball_over_plane());
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  const ToolRun baked =
      folder.run({"bake", "transfer", folder.path("ball.glb"), "-o", folder.path("ball.nook"), "--lobes",
                  "162", "--report", folder.path("b.json")});
  INFO(baked.error);
  REQUIRE(baked.exit_code == 0);
  CHECK(baked.error.find("tangents from their texture coordinates") != std::string::npos);
  const Json report = Json::parse(read_text(folder.path("b.json"))).at("rows").at(0);
  CHECK(report.at("lobes") == 162);
  CHECK(report.at("file_bytes") == read_text(folder.path("ball.nook")).size());
  const ToolRun inspected = folder.run({"inspect", folder.path("ball.nook")});
  CHECK(inspected.out.find("radiance transfer") != std::string::npos);
  CHECK(inspected.out.find("ball.glb") != std::string::npos);

  const ToolRun material =
      folder.run({"bake", "material", "--meso", "weave", "--directions", "12", "--texels", "12", "--bounces",
                  "0", "--view-map", "8", "-o", folder.path("weave.nook"), "--keep-raw",
                  folder.path("weave.raw"), "--quiet"});
  INFO(material.error);
  REQUIRE(material.exit_code == 0);
  const ToolRun run = folder.run({"evaluate", "transfer", folder.path("ball.glb"), folder.path("ball.nook"),
                                  "--material", folder.path("weave.nook"), "--light", folder.path("sky.hdr"),
                                  "--images", folder.path("pictures"), "--width", "64", "--height", "48",
                                  "--paths", "32", "--report", folder.path("e.json")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json rows = Json::parse(read_text(folder.path("e.json"))).at("rows");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("form") == "separated");
  CHECK(rows[0].at("se_db") > rows[1].at("se_db"));
  CHECK(rows[1].at("se_db") > rows[2].at("se_db"));
  CHECK(rows[0].at("mse") < rows[2].at("mse"));
  CHECK(read_text(folder.path("pictures/sky.png")).substr(1, 3) == "PNG");
  CHECK(rows[0].at("truth") == "decoded material, direct light");

  // Against the raw material the error of compression comes on top, and the vectors are the same.
  const auto evaluate_raw = [&](const std::string& raw) {
    return folder.run({"evaluate", "transfer", folder.path("ball.glb"), folder.path("ball.nook"),
                       "--material", folder.path("weave.nook"), "--raw", raw, "--light",
                       folder.path("sky.hdr"), "--width", "64", "--height", "48", "--paths", "32", "--report",
                       folder.path("r.json")});
  };
  const ToolRun against_raw = evaluate_raw(folder.path("weave.raw"));
  INFO(against_raw.error);
  REQUIRE(against_raw.exit_code == 0);
  const Json raw_rows = Json::parse(read_text(folder.path("r.json"))).at("rows");
  CHECK(raw_rows[0].at("truth") == "raw material, direct light");
  CHECK(raw_rows[0].at("se_db") == rows[0].at("se_db"));
  CHECK(raw_rows[0].at("mse") > rows[0].at("mse"));
  CHECK(raw_rows[0].at("mse") < raw_rows[2].at("mse"));
  CHECK(evaluate_raw(folder.path("weave.nook")).exit_code == 3);
}

TEST_CASE("bake and evaluate transfer: reflections, holes and the paper's form") {
  const TestFolder folder;
  write_shape(folder.path("ball.glb"), ball_over_plane());
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  for (const char* seed : {"1", "2"}) {
    const ToolRun material =
        folder.run({"bake", "material", "--meso", "weave", "--directions", "12", "--texels", "12",
                    "--bounces", "0", "--view-map", "8", "--radius", seed[0] == '1' ? "0.1" : "0.06", "-o",
                    folder.path(std::string("weave") + seed), "--quiet"});
    INFO(material.error);
    REQUIRE(material.exit_code == 0);
  }
  const auto evaluate = [&](const char* material) {
    return folder.run({"evaluate", "transfer", folder.path("ball.glb"), folder.path("b.nook"), "--material",
                       folder.path(material), "--light", folder.path("sky.hdr"), "--width", "48", "--height",
                       "36", "--paths", "16", "--report", folder.path("e.json")});
  };
  const auto first_row = [&] { return Json::parse(read_text(folder.path("e.json"))).at("rows").at(0); };
  ToolRun run = folder.run({"bake", "transfer", folder.path("ball.glb"), "-o", folder.path("b.nook"),
                            "--lobes", "42", "--bounces", "2", "--votf", folder.path("weave1"), "--tiles",
                            "4", "--report", folder.path("b.json")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json baked = Json::parse(read_text(folder.path("b.json"))).at("rows").at(0);
  CHECK(baked.at("bounces") == 2);
  CHECK(baked.at("indirect_bytes") == 36 * baked.at("vertices").get<int>());
  CHECK(baked.at("votf").get<std::string>().size() == 16);
  run = folder.run({"inspect", folder.path("b.nook")});
  CHECK(run.out.find(baked.at("votf").get<std::string>()) != std::string::npos);
  run = evaluate("weave1");
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.find("another material") == std::string::npos);
  CHECK(first_row().at("truth") == "decoded material, 2 bounces, holes of the VOTF");
  CHECK(first_row().at("truth_bounces") == 2);
  run = evaluate("weave2");
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.find("holes of another material") != std::string::npos);

  run = folder.run({"bake", "transfer", folder.path("ball.glb"), "-o", folder.path("b.nook"), "--lobes",
                    "162", "--form", "paper", "--material", folder.path("weave1"), "--clusters", "6",
                    "--report", folder.path("b.json")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(Json::parse(read_text(folder.path("b.json"))).at("rows").at(0).at("form") == "paper");
  run = evaluate("weave1");
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(first_row().at("form") == "paper");
  const Json rows = Json::parse(read_text(folder.path("e.json"))).at("rows");
  CHECK(rows[0].at("se_db") > rows[1].at("se_db"));
  run = evaluate("weave2");
  CHECK(run.exit_code == 2);
  CHECK(run.error.find("light modes") != std::string::npos);
  REQUIRE(folder
              .run({"bake",       "material", "--meso",   "weave",     "--directions",
                    "12",         "--texels", "12",       "--bounces", "0",
                    "--view-map", "8",        "--method", "neural",    "--channels",
                    "4",          "--steps",  "8",        "-o",        folder.path("neural"),
                    "--quiet"})
              .exit_code == 0);
  run = evaluate("neural");
  CHECK(run.exit_code == 2);
  CHECK(run.error.find("the material is neural") != std::string::npos);
  CHECK(
      folder
          .run({"bake", "transfer", folder.path("ball.glb"), "-o", folder.path("c.nook"), "--form", "paper"})
          .exit_code == 2);
}

TEST_CASE("bake transfer: the same bytes on any number of threads") {
  const TestFolder folder;
  write_shape(folder.path("ball.glb"), ball_over_plane());
  for (const char* threads : {"1", "2"})
    REQUIRE(folder
                .run({"bake", "transfer", folder.path("ball.glb"), "--lobes", "42", "--threads", threads,
                      "-o", folder.path(threads), "--quiet"})
                .exit_code == 0);
  CHECK(read_text(folder.path("1")) == read_text(folder.path("2")));
}

TEST_CASE("evaluate transfer: a file of another mesh is refused") {
  const TestFolder folder;
  write_shape(folder.path("a.glb"), shapes::plane(1, 3, 1));
  write_shape(folder.path("b.glb"), shapes::plane(1.01f, 3, 1));
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  REQUIRE(folder
              .run({"bake", "transfer", folder.path("a.glb"), "--lobes", "12", "-o", folder.path("a.nook"),
                    "--quiet"})
              .exit_code == 0);
  const ToolRun run = folder.run({"evaluate", "transfer", folder.path("b.glb"), folder.path("a.nook"),
                                  "--material", folder.path("a.nook"), "--light", folder.path("sky.hdr")});
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("another mesh") != std::string::npos);
}

TEST_CASE("bake transfer: bad input and bad arguments leave no file") {
  const TestFolder folder;
  write_shape(folder.path("a.glb"), shapes::plane(1, 3, 1));
  CHECK(folder.run({"bake", "transfer", folder.path("a.glb"), "--lobes", "3", "-o", folder.path("a.nook")})
            .exit_code == 2);
  write_text(folder.path("cut.glb"), read_text(folder.path("a.glb")).substr(0, 200));
  const ToolRun run =
      folder.run({"bake", "transfer", folder.path("cut.glb"), "-o", folder.path("a.nook"), "--quiet"});
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("cut.glb") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"a.glb", "cut.glb"});
}
