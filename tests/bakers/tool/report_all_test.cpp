// nook report --all: one page about every baked file of a folder.
#include <sys/resource.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string hostile = "a & b <img src=x> 'c' \"d\"";

struct Probe {
  std::string model, report;
};

// A small bake that is quick, with its report.
Probe bake_probe(const TestFolder& folder, const std::string& seed = "1") {
  write_text(folder.path("sky.hdr"), rgbe_map(64, 32));
  const ToolRun run = folder.run({"bake", "probe", folder.path("sky.hdr"), "-o", folder.path("sky.nook"),
                                  "--report", folder.path("sky.json"), "--sampling", "luminance", "--samples",
                                  "4096", "--seed", seed, "--quiet"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  Probe probe{read_text(folder.path("sky.nook")), read_text(folder.path("sky.json"))};
  for (const char* name : {"sky.hdr", "sky.nook", "sky.json"}) fs::remove(folder.path(name));
  return probe;
}

// The report with another error. 0.1 is the limit of poor.
std::string with_error(const Probe& probe, double error) {
  Json report = Json::parse(probe.report);
  report["rows"][0]["irradiance_relative"] = error;
  report["rows"][0]["irradiance_minimum"] = 0.1;
  return report.dump();
}

void put(const TestFolder& folder, const std::string& name, const Probe& probe, double error) {
  write_text(folder.path(name + ".nook"), probe.model);
  write_text(folder.path(name + ".json"), with_error(probe, error));
}

struct PageRow {
  std::string name, kind, state, figure, notes, change, log;
  Json over_limit, seconds;
  std::size_t bytes = 0;
  unsigned flags = 0;
};

std::vector<PageRow> rows_of(const std::string& path) {
  const std::string page = read_text(path), opening = "<script type=\"application/json\" id=\"results\">";
  const std::size_t begin = page.find(opening);
  REQUIRE(begin != std::string::npos);
  const std::size_t first = begin + opening.size();
  const Json data = Json::parse(page.substr(first, page.find("</script>", first) - first));
  std::vector<PageRow> rows;
  for (const Json& r : data["rows"])
    rows.push_back({r[0], r[1], data["states"][r[2].get<std::size_t>()], r[4], r[5],
                    data["changes"][r[9].get<std::size_t>()], r[13], r[3], r[7], r[6], r[11]});
  return rows;
}

PageRow row_of(const std::vector<PageRow>& rows, const std::string& name) {
  for (const PageRow& row : rows)
    if (row.name == name) return row;
  FAIL("no row " << name);
  return {};
}

ToolRun report_all(const TestFolder& folder, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"report", "--all", folder.path("farm"), "-o", folder.path("all.html"),
                                     "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return folder.run(arguments);
}

std::vector<PageRow> page_of(const TestFolder& folder) {
  const ToolRun run = report_all(folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  return rows_of(folder.path("all.html"));
}

// Processor time of all programs that this one has run.
double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void make_folders(const TestFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) fs::create_directories(folder.path(name));
}

}  // namespace

TEST_CASE("the page of a folder has failures on top, then the worst") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder);
  make_folders(folder, {"farm/props"});
  put(folder, "farm/good", probe, 0.05);
  put(folder, "farm/props/poor", probe, 0.15);
  put(folder, "farm/bad", probe, 0.25);
  put(folder, "farm/" + hostile, probe, 0.07);
  write_text(folder.path("farm/good.log"), "nook: written\nexit code 0\n");
  write_text(folder.path("farm/good.html"), "<!doctype html>");
  write_text(folder.path("farm/bare.nook"), probe.model);
  write_text(folder.path("farm/cut.nook"), probe.model.substr(0, probe.model.size() / 2));
  write_text(folder.path("farm/empty.nook"), "");
  fs::create_symlink("nowhere", folder.path("farm/dangling.nook"));
  write_text(folder.path("farm/refused.log"), "reading\nnook: x.glb: has <no> mesh\n\nexit code 3\n");
  put(folder, "farm/again", probe, 0.05);
  write_text(folder.path("farm/again.log"), "nook: no space left\r\nexit code 1\r\n");
  write_text(folder.path("farm/killed.nook.log"), "ray tracing 40 %\n");
  write_text(folder.path("farm/silent.log"), "");
  write_text(folder.path("farm/between.json"), with_error(probe, 0.05));
  write_text(folder.path("farm/half.nook.nook-part-12"), "NOOK");

  const std::vector<PageRow> rows = page_of(folder);
  std::vector<std::string> order;
  for (const PageRow& row : rows) order.push_back(row.state + " " + row.name);
  CHECK(order == std::vector<std::string>{"failed again", "failed between", "failed half", "failed killed",
                                          "failed refused", "failed silent", "broken cut", "broken dangling",
                                          "broken empty", "bad bad", "poor props/poor", "good " + hostile,
                                          "good good", "not measured bare"});
  CHECK(row_of(rows, "refused").notes == "exit code 3: nook: x.glb: has <no> mesh");
  CHECK(row_of(rows, "again").notes == "exit code 1: nook: no space left");
  CHECK(row_of(rows, "killed").notes.find("was killed; last line: ray tracing 40 %") != std::string::npos);
  for (const char* name : {"cut", "dangling", "empty", "between", "half", "silent"}) {
    INFO(name);
    CHECK(row_of(rows, name).notes.size() > 10);
    // The row has the name already.
    CHECK(row_of(rows, name).notes.find(folder.path("farm")) == std::string::npos);
  }
  const PageRow good = row_of(rows, "good");
  CHECK(good.kind == "light probe");
  CHECK(good.bytes == probe.model.size());
  CHECK(good.over_limit == 0.5);
  CHECK(good.seconds.is_number());
  CHECK((good.flags & 1) == 1);  // a page
  CHECK(good.log == "good.log");
  CHECK((row_of(rows, "bad").flags & 1) == 0);
  CHECK(row_of(rows, "killed").log == "killed.nook.log");
  CHECK(row_of(rows, "bare").figure.find("--report") != std::string::npos);
  // No name or note is markup.
  const std::string page = read_text(folder.path("all.html"));
  CHECK(page.find("<img") == std::string::npos);
  CHECK(page.find("<no>") == std::string::npos);
  CHECK(page.find("14 assets: 6 failed, 3 broken, 1 bad, 1 poor, 2 good, 1 not measured") !=
        std::string::npos);
}

TEST_CASE("logs of a plan belong to the models that they are named after") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder);
  make_folders(folder, {"farm/game/out", "farm/game/build/nook/logs/out"});
  put(folder, "farm/game/out/hero", probe, 0.05);
  put(folder, "farm/game/out/fails", probe, 0.05);
  const std::string logs = "farm/game/build/nook/logs/out/";
  write_text(folder.path(logs + "hero.nook.log"),
             "nook task: attempt 1\nnook task: exit code 0 after 2.10 s\n");
  put(folder, "farm/game/out/killed", probe, 0.05);
  write_text(folder.path(logs + "killed.nook.log"), "nook task: attempt 1 of 2\n");
  write_text(folder.path(logs + "fails.nook.log"), "nook: no\nexit code 3\n");
  write_text(folder.path(logs + "lost.nook.log"), "nook: no\nexit code 3\n");
  const std::vector<PageRow> rows = page_of(folder);
  REQUIRE(rows.size() == 4);
  // An earlier bake left the model.
  CHECK(row_of(rows, "game/out/killed").state == "failed");
  CHECK(row_of(rows, "game/out/hero").state == "good");
  CHECK(row_of(rows, "game/out/hero").log == "game/build/nook/logs/out/hero.nook.log");
  CHECK(row_of(rows, "game/out/fails").state == "failed");
  CHECK(row_of(rows, "game/out/lost").state == "failed");
}

TEST_CASE("only traces of bakes are assets") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder);
  make_folders(folder, {"farm/.git", "farm/ab"});
  put(folder, "farm/one", probe, 0.05);
  write_text(folder.path("farm/nook.json"), "{\"assets\": []}");
  write_text(folder.path("farm/list.json"), "[1, 2");
  write_text(folder.path("farm/one.glb.txt"), "x");
  put(folder, "farm/.git/hidden", probe, 0.05);
  put(folder, "farm/ab/" + std::string(64, 'a'), probe, 0.05);  // a cache in the folder
  fs::create_directory_symlink(folder.path("farm"), folder.path("farm/circle"));
  REQUIRE(mkfifo(folder.path("farm/pipe.log").c_str(), 0600) == 0);
  REQUIRE(mkfifo(folder.path("farm/pipe.nook").c_str(), 0600) == 0);
  const std::vector<PageRow> rows = page_of(folder);
  REQUIRE(rows.size() == 2);
  CHECK(row_of(rows, "pipe").notes == "is not a regular file");
  CHECK(row_of(rows, "one").state == "good");
}

TEST_CASE("a report of another bake does not judge a model") {
  const TestFolder folder;
  Probe probe = bake_probe(folder);
  make_folders(folder, {"farm"});
  Json report = Json::parse(with_error(probe, 0.05));
  report["rows"][0]["bytes"] = probe.model.size() + 1;
  write_text(folder.path("farm/one.nook"), probe.model);
  write_text(folder.path("farm/one.json"), report.dump());
  write_text(folder.path("farm/two.nook"), probe.model);
  write_text(folder.path("farm/two.json"), "{\"rows\": [");
  const std::vector<PageRow> rows = page_of(folder);
  CHECK(row_of(rows, "one").state == "not measured");
  CHECK(row_of(rows, "one").notes == "its report belongs to another bake");
  CHECK(row_of(rows, "two").notes == "its report is not JSON");
}

TEST_CASE("the page says what changed since the last page") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder), other = bake_probe(folder, "2");
  REQUIRE(probe.model != other.model);
  make_folders(folder, {"farm"});
  for (const char* name : {"same", "better", "worse", "key", "lost", "fails"})
    put(folder, std::string("farm/") + name, probe, 0.09);
  CHECK(read_text(folder.path("all.html")).empty());
  for (const PageRow& row : page_of(folder)) CHECK(row.change == "same");
  CHECK(read_text(folder.path("all.html")).find("no earlier page") != std::string::npos);
  const std::string first = read_text(folder.path("all.html"));

  put(folder, "farm/better", probe, 0.05);
  put(folder, "farm/worse", probe, 0.11);
  put(folder, "farm/key", other, 0.09);
  put(folder, "farm/new", probe, 0.09);
  fs::remove(folder.path("farm/lost.nook"));
  fs::remove(folder.path("farm/lost.json"));
  fs::remove(folder.path("farm/fails.nook"));
  write_text(folder.path("farm/fails.log"), "nook: no\nexit code 2\n");
  std::vector<PageRow> rows = page_of(folder);
  for (const auto& [name, change] : std::vector<std::pair<std::string, std::string>>{{"same", "same"},
                                                                                     {"better", "better"},
                                                                                     {"worse", "worse"},
                                                                                     {"key", "other key"},
                                                                                     {"new", "new"},
                                                                                     {"lost", "gone"},
                                                                                     {"fails", "worse"}}) {
    INFO(name);
    CHECK(row_of(rows, name).change == change);
  }
  CHECK(rows.back().name == "lost");
  CHECK(rows.front().kind == "light probe");  // of the task that failed, by the last page
  CHECK(read_text(folder.path("all.html")).find("1 new, 2 worse, 1 better, 1 other key, 1 gone") !=
        std::string::npos);

  // Once more: what is gone is forgotten, and nothing changed.
  for (const PageRow& row : page_of(folder)) CHECK(row.change == "same");
  write_text(folder.path("first.html"), first);
  REQUIRE(report_all(folder, {"--since", folder.path("first.html")}).exit_code == 0);
  rows = rows_of(folder.path("all.html"));
  CHECK(row_of(rows, "lost").change == "gone");
}

TEST_CASE("report --all refuses what it cannot read or would destroy") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder);
  const auto exit_code = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "report");
    arguments.push_back("--quiet");
    return folder.run(arguments).exit_code;
  };
  const std::string farm = folder.path("farm"), page = folder.path("all.html");
  CHECK(exit_code({"--all", farm, "-o", page}) == 3);  // it does not exist
  make_folders(folder, {"farm/empty"});
  CHECK(exit_code({"--all", farm, "-o", page}) == 3);
  write_text(folder.path("farm/notes.json"), "{}");
  CHECK(exit_code({"--all", farm, "-o", page}) == 3);
  put(folder, "farm/one", probe, 0.05);
  const std::string model = folder.path("farm/one.nook");
  CHECK(exit_code({"--all", model, "-o", page}) == 3);  // a file
  CHECK(exit_code({"--all", farm, "-o", model}) == 2);
  CHECK(exit_code({"--all", farm, "-o", folder.path("farm/one.json")}) == 2);
  CHECK(exit_code({"--all", farm, "-o", page, "--report", model}) == 2);
  CHECK(exit_code({model, "--all", farm, "-o", page}) == 2);
  CHECK(exit_code({model, "--since", page, "-o", page}) == 2);
  CHECK(exit_code({"--all", farm, "-o", folder.path("none/all.html")}) == 1);
  write_text(folder.path("else.html"), "<!doctype html>");
  CHECK(exit_code({"--all", farm, "-o", page, "--since", folder.path("else.html")}) == 3);
  CHECK(exit_code({"--all", farm, "-o", page, "--since", folder.path("none.html")}) == 3);
  CHECK(exit_code({"-o", page}) == 2);
  CHECK(exit_code({}) == 2);
  CHECK(read_text(model) == probe.model);
  CHECK(folder.names() == std::vector<std::string>{"else.html", "farm"});

  // Another page at the place of the output is replaced, with a word about it.
  write_text(page, "<!doctype html>");
  const ToolRun run = report_all(folder);
  CHECK(run.exit_code == 0);
  CHECK(run.error.find("changes are not shown") != std::string::npos);
  CHECK(rows_of(page).size() == 1);
  // Without -o the page is in the folder, and is itself not an asset.
  for (int i = 0; i < 2; ++i) REQUIRE(exit_code({"--all", farm}) == 0);
  CHECK(rows_of(folder.path("farm/nook_report.html")).size() == 1);
}

TEST_CASE("one page on any number of threads") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder);
  make_folders(folder, {"farm"});
  for (int i = 0; i < 40; ++i) put(folder, "farm/" + std::to_string(i), probe, 0.01 * (i % 7));
  std::vector<std::vector<PageRow>> pages;
  for (const char* threads : {"1", "3"}) {
    fs::remove(folder.path("all.html"));
    REQUIRE(report_all(folder, {"--threads", threads}).exit_code == 0);
    pages.push_back(rows_of(folder.path("all.html")));
  }
  REQUIRE(pages[0].size() == 40);
  for (std::size_t i = 0; i < 40; ++i) CHECK(pages[0][i].name == pages[1][i].name);
}

TEST_CASE("a page of 5,000 bakes is made in seconds") {
  const TestFolder folder;
  const Probe probe = bake_probe(folder);
  for (int i = 0; i < 5000; ++i) {
    const std::string place = "farm/" + std::to_string(i % 50) + "/hero " + std::to_string(i);
    if (i < 50) make_folders(folder, {"farm/" + std::to_string(i)});
    if (i % 100 == 0)
      write_text(folder.path(place + ".log"), "nook: bad input\nexit code 3\n");
    else
      put(folder, place, probe, 0.0001 * (i % 2000));
  }
  const double before = children_seconds();
  REQUIRE(report_all(folder, {"--report", folder.path("r.json")}).exit_code == 0);
  const double seconds = children_seconds() - before;
  const Json row = Json::parse(read_text(folder.path("r.json"))).at("rows").at(0);
  INFO(row.dump());
  CHECK(row.at("assets") == 5000);
  CHECK(row.at("failed") == 50);
  // A page that a director opens each morning, also on a phone.
  CHECK(row.at("page_bytes") <= 10'000'000);
  // A studio's script runs it after each build; more would be felt. Processor time does not depend on what
  // else the machine does.
  CHECK(seconds <= 10);
}
