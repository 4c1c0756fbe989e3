#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

// more: options that are added, or take the place of those here.
std::vector<std::string> small_bake(const TestFolder& folder, const std::string& output,
                                    const std::map<std::string, std::string>& more = {}) {
  std::map<std::string, std::string> options = {
      {"--meso", "fiber"}, {"-o", folder.path(output)}, {"--texels", "12"},   {"--directions", "12"},
      {"--detail", "0.3"}, {"--bounce-rays", "8"},      {"--view-map", "16"}, {"--ranks", "8,8,8,8"},
      {"--bits", "16"},    {"--votf-ranks", "8,8"},     {"--mixture", "2"}};
  for (const auto& [name, value] : more) options[name] = value;
  std::vector<std::string> arguments = {"bake", "material"};
  for (const auto& [name, value] : options) arguments.insert(arguments.end(), {name, value});
  return arguments;
}

}  // namespace

TEST_CASE(
    "bake material writes a material and its raw file, which evaluate compares, the same on any threads") {
  const TestFolder folder;
  const ToolRun run = folder.run(small_bake(
      folder, "a.nook",
      {{"--keep-raw", folder.path("a.raw")}, {"--report", folder.path("r.json")}, {"--threads", "1"}}));
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  REQUIRE(folder.run(small_bake(folder, "b.nook", {{"--threads", "2"}})).exit_code == 0);
  CHECK(read_text(folder.path("a.nook")) == read_text(folder.path("b.nook")));
  const auto baked = nlohmann::json::parse(read_text(folder.path("r.json")));
  const auto& row = baked.at("rows").at(0);
  CHECK(row.at("method") == "K-CTA");
  CHECK(row.at("views") == 12);
  CHECK(row.at("file_bytes") == read_text(folder.path("a.nook")).size());
  CHECK(baked.at("recipe").at("source").at("meso") == "fiber");

  const ToolRun measured =
      folder.run({"evaluate", "material", folder.path("a.raw"), folder.path("a.nook"), "--peers", "--sweep",
                  "4,8", "--images", folder.path("images"), "--report", folder.path("e.json")});
  INFO(measured.error);
  REQUIRE(measured.exit_code == 0);
  const auto report = nlohmann::json::parse(read_text(folder.path("e.json")));
  // The file, N-SVD, CTA, K-CTA with K = 2 (two clusters allow no more), N-SVD and PCA of the file's bytes.
  REQUIRE(report.at("rows").size() == 6);
  CHECK(report.at("rows").at(0).at("file_bytes") == read_text(folder.path("a.nook")).size());
  for (const char* list : {"rows", "sweep"})
    for (const auto& each : report.at(list)) {
      INFO(each);
      // Numbers alone, and what a user ships.
      CHECK(each.at("file_bytes").get<int>() > each.at("bytes").get<int>());
    }
  // 16 x 16 cells of 2 clusters, each with an index of a byte and 4 half floats, in BTF and VOTF.
  CHECK(report.at("rows").at(3).at("file_bytes").get<int>() - report.at("rows").at(3).at("bytes").get<int>() >
        2 * 16 * 16 * 2 * 9);
  CHECK(report.at("rows").at(4).at("method") == "N-SVD, equal bytes");
  CHECK(report.at("rows").at(4).at("view_rank") > report.at("rows").at(1).at("view_rank"));
  CHECK(report.at("rows").at(4).at("file_bytes") <= report.at("rows").at(0).at("file_bytes"));
  CHECK(report.at("rows").at(4).at("se_db") > report.at("rows").at(1).at("se_db"));
  CHECK(report.at("rows").at(0).at("se_db").get<double>() ==
        Approx(row.at("se_db").get<double>()).margin(1e-6));
  CHECK(report.at("rows").at(5).at("method") == "PCA");
  CHECK(report.at("rows").at(5).at("file_bytes") <= report.at("rows").at(0).at("file_bytes"));
  CHECK(report.at("sweep").size() == 5);
  CHECK(read_text(folder.path("images") + "/fiber_sweep_se.svg").find("</svg>") != std::string::npos);
  CHECK(!read_text(folder.path("images") + "/fiber_file.png").empty());

  // From the raw file comes the same material again.
  REQUIRE(folder
              .run({"bake", "material", "--raw", folder.path("a.raw"), "-o", folder.path("c.nook"),
                    "--view-map", "16", "--bits", "16", "--ranks", "8,8,8,8", "--votf-ranks", "8,8",
                    "--mixture", "2", "--report", folder.path("c.json")})
              .exit_code == 0);
  const auto again = nlohmann::json::parse(read_text(folder.path("c.json")));
  CHECK(again.at("rows").at(0).at("se_db") == row.at("se_db"));
}

TEST_CASE("bake material refuses what it cannot bake, by name, and leaves nothing behind") {
  const TestFolder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& word) {
    const ToolRun run = folder.run(arguments);
    INFO(run.error);
    CHECK(run.exit_code == code);
    CHECK((run.error + run.out).find(word) != std::string::npos);
    CHECK(folder.names().empty());
  };
  refused({"bake", "material", "-o", folder.path("a.nook")}, 2, "--meso");
  refused({"bake", "material", "--meso", "felt", "-o", folder.path("a.nook")}, 2, "felt");
  refused(small_bake(folder, "a.nook", {{"--ranks", "8,13,8,8"}}), 2, "view rank is 13");
  refused(small_bake(folder, "a.nook", {{"--ranks", "8,8,8"}}), 2, "--ranks");
  refused(small_bake(folder, "a.nook", {{"--clusters", "20"}}), 2, "clusters is 20");
  refused(small_bake(folder, "a.nook", {{"--radius", "0"}}), 2, "radius");
  refused({"bake", "material", "--btf", folder.path("nowhere"), "-o", folder.path("a.nook")}, 3, "nowhere");
  refused({"bake", "material", "--raw", folder.path("none.raw"), "-o", folder.path("a.nook")}, 3, "none.raw");
}

TEST_CASE("bake material stops at a signal and leaves nothing behind") {
  const TestFolder folder;
  const ToolRun run = folder.run_and_signal({"bake", "material", "--meso", "roughhole", "-o",
                                             folder.path("a.nook"), "--texels", "96", "--directions", "100"},
                                            SIGINT, "ray tracing");
  CHECK(run.exit_code == 1);
  CHECK(run.error.find("stopped") != std::string::npos);
  CHECK(folder.names().empty());
}

TEST_CASE("evaluate material refuses files that do not belong together") {
  const TestFolder folder;
  REQUIRE(folder.run(small_bake(folder, "a.nook", {{"--keep-raw", folder.path("a.raw")}})).exit_code == 0);
  REQUIRE(folder.run(small_bake(folder, "b.nook", {{"--texels", "16"}})).exit_code == 0);
  const ToolRun run = folder.run({"evaluate", "material", folder.path("a.raw"), folder.path("b.nook")});
  CHECK(run.exit_code != 0);
  CHECK(run.error.find("b.nook") != std::string::npos);
  CHECK(folder.run({"evaluate", "material", folder.path("a.nook"), folder.path("a.raw")}).exit_code == 3);
}
