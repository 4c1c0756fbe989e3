// The sample as a user runs it, without a display.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.h"

namespace {

int run(const std::string& arguments) {
  std::string command = "'" CROWD "' --quiet ";
  command.append(arguments).append(" > /dev/null");
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

double mse_of(const nlohmann::json& report, const std::string& form) {
  for (const auto& row : report["rows"])
    if (row["form"] == form) return row["mse_area"];
  return -1;
}

}  // namespace

TEST_CASE("a small crowd is drawn, and the more casters count the nearer it is to ray tracing") {
  const std::filesystem::path out = CROWD_OUT;
  std::filesystem::remove_all(out);
  REQUIRE(run("--context egl --characters 12 --frames 2 --size 320x240 --out '" CROWD_OUT "'") == 0);
  // A picture of one colour of this size has less than a kilobyte.
  for (const char* name : {"frame_0000.png", "frame_0001.png", "sheet.png", "double_shadowing.png"})
    CHECK(std::filesystem::file_size(out / name) > 5000);
  const auto report = nlohmann::json::parse(std::ifstream(out / "report.json"));
  CHECK(report["characters"] == 12);
  CHECK(report["links"] > 0);
  for (const char* stage : {"pose", "scene_update", "screen_space", "draw", "read"})
    CHECK(report["ms"][stage] > 0);
  const double all = mse_of(report, "all");
  CHECK(all > 0);
  CHECK(all < mse_of(report, "self_ground"));
  CHECK(all < mse_of(report, "self_links"));
  CHECK(mse_of(report, "self_ground") < mse_of(report, "self"));
  CHECK(mse_of(report, "self") < mse_of(report, "static"));
}

TEST_CASE("bad arguments end with code 2, a bad character with 3") {
  CHECK(run("--size 3 2> /dev/null") == 2);
  CHECK(run("--tier 40 2> /dev/null") == 2);
  CHECK(run("--screen-space maybe 2> /dev/null") == 2);
  CHECK(run("no_such_file.glb 2> /dev/null") == 2);
  const std::filesystem::path broken = std::filesystem::temp_directory_path() / "crowd_test_broken.glb";
  std::ofstream(broken) << "not a character";
  CHECK(run(broken.string() + " 2> /dev/null") == 3);
  std::filesystem::remove(broken);
}
