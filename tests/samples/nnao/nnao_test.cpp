// The sample as a user runs it: its pictures, and its exit codes.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/samples/sample_run.h"

using nook::test::Folder, nook::test::quoted;

namespace {

using Picture = nook::test::SamplePicture<float>;

Picture read(const std::filesystem::path& path) {
  return nook::test::read_picture<float>(path, 960, 540);
}

int run(const std::string& arguments) {
  return nook::test::exit_code(quoted(NNAO_SAMPLE) + " " + arguments + " 2> /dev/null");
}

}  // namespace

TEST_CASE("sample nnao: its pictures show a room that AO darkens, in the corners and nowhere else") {
  const Folder folder;
  REQUIRE(run(quoted(folder.path)) == 0);
  const Picture before = read(folder.path / "before.png"), after = read(folder.path / "after.png"),
                ao = read(folder.path / "ao.png");
  // Open floor, sky above the walls, the corner of wall and wall, the floor under the ball.
  CHECK(ao.at(480, 500) > 0.95f);
  CHECK(ao.at(600, 5) == 1);
  CHECK(ao.at(370, 150) < 0.8f);
  CHECK(ao.at(541, 362) < 0.7f);
  float brighter = 0;
  for (std::size_t i = 0; i < before.values.size(); ++i)
    brighter = std::max(brighter, after.values[i] - before.values[i]);
  CHECK(brighter <= 0);
  CHECK(after.at(480, 500) > before.at(480, 500) - 0.03f);
  CHECK(after.at(541, 362) < before.at(541, 362) - 0.08f);
}

TEST_CASE("sample nnao: bad arguments and folders have exit codes of their own") {
  const Folder folder;
  CHECK(run(quoted(folder.path) + " 0") == 2);
  CHECK(run("a b c") == 2);
  CHECK(run(quoted(folder.path / "absent")) == 1);
  CHECK(std::filesystem::is_empty(folder.path));
}

#ifdef NOOK_TOOL
TEST_CASE("sample nnao: its recorded frame replays to the same AO, and the tool shows what it holds") {
  const Folder folder;
  REQUIRE(run(quoted(folder.path)) == 0);
  const std::string path = folder.path.string(), frame = path + "/frame.nook";
  const auto tool_run = [&](const std::string& arguments) {
    return nook::test::exit_code(quoted(NOOK_TOOL) + " " + arguments + " 2> /dev/null");
  };
  REQUIRE(tool_run("evaluate nnao --frame " + frame + " --methods replayed,fast --quiet --images " + path +
                   "/replay --report " + path + "/r.json") == 0);
  const auto report = nlohmann::json::parse(std::ifstream(path + "/r.json"));
  const auto& rows = report.at("rows");
  REQUIRE(rows.size() == 3);
  CHECK(rows.at(0).at("method") == "recorded");
  CHECK(rows.at(0).at("resolution") == "960x540");
  CHECK(rows.at(1).at("method") == "replayed");
  // The same driver: within one step of 8 bits.
  CHECK(rows.at(1).at("largest_difference") <= 1.0 / 255 + 1e-9);
  CHECK(rows.at(1).at("share_beyond_step") == 0);
  CHECK(rows.at(2).at("largest_difference") > 0.05);
  CHECK(rows.at(2).at("oracle_mse").is_null());
  const Picture shown = read(folder.path / "ao.png"),
                recorded = read(folder.path / "replay" / "frame_recorded.png");
  float largest = 0;
  for (int y = 0; y < 540; ++y)
    for (int x = 0; x < 960; ++x) largest = std::max(largest, std::abs(shown.at(x, y) - recorded.at(x, y)));
  CHECK(largest < 1e-6f);
  for (const char* name : {"depth", "normals", "replayed", "difference", "fast"})
    CHECK(std::filesystem::exists(folder.path / "replay" / ("frame_" + std::string(name) + ".png")));

  REQUIRE(tool_run("inspect " + frame + " --quiet --report " + path + "/i.json") == 0);
  const auto row = nlohmann::json::parse(std::ifstream(path + "/i.json")).at("rows").at(0);
  CHECK(row.at("note") == "the room of samples/nnao");
  CHECK(row.at("width") == 960);
  // The planes follow from a matrix of floats.
  CHECK(std::abs(row.at("near").get<double>() - 0.1) < 1e-4);
  CHECK(std::abs(row.at("far").get<double>() - 50) < 0.05);
  CHECK(row.at("taps") == 9);
  CHECK(row.at("reversed") == false);

  std::ofstream(path + "/cut.nook", std::ios::binary) << "NOOK";
  CHECK(tool_run("evaluate nnao --frame " + path + "/cut.nook") == 3);
  CHECK(tool_run("evaluate nnao --frame " + path + "/absent.nook") == 3);
  CHECK(tool_run("evaluate nnao --frame " + frame + " --methods nnao:16") == 2);
  CHECK(tool_run("evaluate nnao") == 2);
}
#endif
