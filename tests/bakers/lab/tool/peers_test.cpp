// The commands of nook-lab that add other methods to the commands of nook, run as a user runs them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

Json report_of(const TestFolder& folder) {
  return Json::parse(read_text(folder.path("r.json")));
}

ToolRun lab(const TestFolder& folder, Words words, const Words& more = {}) {
  words.insert(words.end(), more.begin(), more.end());
  return folder.run_program(NOOK_LAB_TOOL, words);
}

void bake(const TestFolder& folder, const Words& words) {
  const ToolRun run = folder.run(words);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
}

// Everything that a row of nook holds is in the row of nook-lab, and is the same.
void check_contains(const Json& row, const Json& part) {
  for (const auto& [key, value] : part.items()) {
    INFO(key);
    if (key != "seconds" && key != "peak_bytes") CHECK(row.at(key) == value);
  }
}

void bake_character(const TestFolder& folder) {
  write_text(folder.path("hero.glb"), glb_tube({"walk", "run", "jump", "sit"}));
  bake(folder, {"bake",
                "character",
                folder.path("hero.glb"),
                "-o",
                folder.path("hero.nook"),
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
                "30",
                "--split",
                "half"});
}

void bake_material(const TestFolder& folder, const std::string& name, const Words& more) {
  Words words{"bake",
              "material",
              "--meso",
              "fiber",
              "--texels",
              "12",
              "--directions",
              "12",
              "--detail",
              "0.3",
              "--bounce-rays",
              "8",
              "--view-map",
              "16",
              "--ranks",
              "8,8,8,8",
              "--votf-ranks",
              "8,8",
              "--mixture",
              "2",
              "--bits",
              "16",
              "-o",
              folder.path(name + ".nook"),
              "--keep-raw",
              folder.path(name + ".raw")};
  words.insert(words.end(), more.begin(), more.end());
  bake(folder, words);
}

}  // namespace

TEST_CASE("evaluate character adds a linear pose model and pose clusters to nook's row") {
  const TestFolder folder;
  bake_character(folder);
  const Words words{
      "evaluate", "character", folder.path("hero.glb"), folder.path("hero.nook"), "--rays", "64", "--poses",
      "training", "--report",  folder.path("r.json")};
  bake(folder, words);
  const Json own = report_of(folder).at("rows").at(0);
  const ToolRun run = lab(folder, words, {"--threads", "1"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json row = report_of(folder).at("rows").at(0);
  check_contains(row, own);
  CHECK(row.size() == own.size() + 2 * 5);
  // On the poses they were fitted to, regressions of the joint angle beat the mean of those poses.
  for (const std::string peer : {"linear_pose", "pose_clusters"}) {
    CHECK(row.at("mse_" + peer).get<double>() < row.at("mse_oracle").get<double>());
    CHECK(row.at("mse_" + peer + "_visible").get<double>() < row.at("mse_oracle_visible").get<double>());
    CHECK(row.at("bytes_" + peer).get<int>() > 0);
  }
  REQUIRE(lab(folder, words, {"--threads", "2"}).exit_code == 0);
  CHECK(report_of(folder).at("rows").at(0) == row);
}

TEST_CASE("evaluate material adds other methods to nook's row, and sweeps view ranks") {
  const TestFolder folder;
  bake_material(folder, "a", {});
  const Words words{"evaluate", "material",           folder.path("a.raw"), folder.path("a.nook"),
                    "--report", folder.path("r.json")};
  bake(folder, words);
  const Json own = report_of(folder).at("rows").at(0);
  const ToolRun run = lab(folder, words, {"--sweep", "4,8", "--images", folder.path("images")});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Json report = report_of(folder), rows = report.at("rows");
  // The file, N-SVD, CTA, K-CTA with K = 2 (two clusters allow no more), N-SVD and PCA of the file's bytes,
  // and the maps of a physically based material.
  REQUIRE(rows.size() == 8);
  check_contains(rows.at(0), own);
  for (const char* list : {"rows", "sweep"})
    for (const Json& each : report.at(list)) {
      INFO(each);
      // Numbers alone, and what a user ships; maps have no more than their numbers.
      const bool is_maps = each.at("method").get<std::string>().starts_with("PBR");
      CHECK(each.at("file_bytes").get<int>() + is_maps > each.at("bytes").get<int>());
    }
  // 16 x 16 cells of 2 clusters, each with an index of a byte and 4 half floats, in BTF and VOTF.
  CHECK(rows.at(3).at("file_bytes").get<int>() - rows.at(3).at("bytes").get<int>() > 2 * 16 * 16 * 2 * 9);
  CHECK(rows.at(4).at("method") == "N-SVD, equal bytes");
  CHECK(rows.at(4).at("view_rank") > rows.at(1).at("view_rank"));
  CHECK(rows.at(4).at("file_bytes") <= rows.at(0).at("file_bytes"));
  CHECK(rows.at(4).at("se_db") > rows.at(1).at("se_db"));
  CHECK(rows.at(5).at("method") == "PCA");
  CHECK(rows.at(5).at("file_bytes") <= rows.at(0).at("file_bytes"));
  CHECK(rows.at(7).at("method") == "PBR, parallax and shadows");
  CHECK(rows.at(7).at("file_bytes") == 7 * 12 * 12);
  CHECK(report.at("sweep").size() == 5);
  CHECK(read_text(folder.path("images") + "/fiber_sweep_se.svg").find("</svg>") != std::string::npos);
  CHECK(!read_text(folder.path("images") + "/fiber_methods.png").empty());
  REQUIRE(lab(folder, words, {"--methods", "none", "--compare-seeding"}).exit_code == 0);
  CHECK(report_of(folder).at("rows").size() == 1);
  CHECK(report_of(folder).at("seeding").size() == 2);
}

TEST_CASE("evaluate material fits nothing at the ranks of a neural material, which has none") {
  const TestFolder folder;
  bake_material(folder, "n", {"--method", "neural", "--channels", "8", "--steps", "60"});
  const Words words{"evaluate", "material", folder.path("n.raw"), folder.path("n.nook")};
  CHECK(lab(folder, words, {"--methods", "pca"}).exit_code == 0);
  for (const Words& fit : std::vector<Words>{{"--methods", "n-svd"},
                                             {},
                                             {"--methods", "none", "--sweep", "4"},
                                             {"--methods", "none", "--compare-seeding"}}) {
    const ToolRun refused = lab(folder, words, fit);
    INFO(refused.error);
    CHECK(refused.exit_code != 0);
    CHECK(refused.error.find("the material is neural") != std::string::npos);
    CHECK(refused.error.find("measuring") == std::string::npos);  // at once
  }
}

TEST_CASE("evaluate probe measures every method, and glossy light") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(32, 16));
  const Words words{"evaluate", "probe",    folder.path("sky.hdr"), "--seeds",
                    "2",        "--report", folder.path("r.json")};
  bake(folder, words);
  const Json own = report_of(folder).at("rows");
  const ToolRun run = lab(folder, words);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.find("running_average_non_negative") != std::string::npos);
  const Json all = report_of(folder).at("rows");
  for (const Json& row : own) CHECK(std::count(all.begin(), all.end(), row) == 1);
  REQUIRE(lab(folder, words, {"--glossy", "--surfaces", "4"}).exit_code == 0);
  const Json glossy = report_of(folder).at("rows");
  REQUIRE(glossy.size() == 12);
  CHECK(glossy.at(1).at("bytes") == 12 * 32);
}
