#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

TEST_CASE("inspect shows what a model holds and refuses what is none") {
  const TestFolder folder;
  write_text(folder.path("hero.glb"), glb_tube({"walk", "run"}));
  REQUIRE(folder
              .run({"bake", "character", folder.path("hero.glb"), "-o", folder.path("hero.nook"), "--preset",
                    "draft", "--auto-poses", "20", "--rays", "4", "--steps", "20", "--spheres", "6",
                    "--key-points", "20", "--quiet"})
              .exit_code == 0);
  const ToolRun run = folder.run({"inspect", folder.path("hero.nook"), "--report", folder.path("r.json")});
  REQUIRE(run.exit_code == 0);
  const auto row = nlohmann::json::parse(read_text(folder.path("r.json"))).at("rows").at(0);
  CHECK(row.at("bones") == 2);
  CHECK(row.at("vertices") == 140);
  CHECK(row.at("spheres").get<int>() <= 6);
  CHECK(row.at("recipe_poses") == "all");
  CHECK(row.at("recipe_clips") == "3");  // both clips: two bits of one hexadecimal digit
  CHECK(row.at("bytes_RECP").get<int>() < 1200);
  CHECK(row.at("world_casters").get<int>() > 0);
  CHECK(row.at("bytes_WCAS").get<int>() <= 2048);
  CHECK(run.out.find("key_points") != std::string::npos);

  const std::string bytes = read_text(folder.path("hero.nook"));
  write_text(folder.path("cut.nook"), bytes.substr(0, bytes.size() - 1));
  const ToolRun cut = folder.run({"inspect", folder.path("cut.nook")});
  CHECK(cut.exit_code == 3);
  CHECK(cut.error.find("cut.nook: ") != std::string::npos);
  CHECK(cut.out.empty());
  CHECK(folder.run({"inspect"}).exit_code == 2);
  CHECK(folder.run({"inspect", folder.path("none.nook")}).exit_code == 3);
}
