// The program as a user runs it: its report against ray tracing.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/catch.h"

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

TEST_CASE("the more casters of a crowd count, the nearer it is to ray tracing") {
  const std::filesystem::path out = CROWD_OUT;
  std::filesystem::remove_all(out);
  REQUIRE(run("--context egl --characters 12 --frames 2 --size 320x240 --out '" CROWD_OUT "'") == 0);
  // A picture of one colour of this size has less than a kilobyte.
  for (const char* name : {"frame_0000.png", "frame_0001.png", "sheet.png", "double_shadowing.png"})
    CHECK(std::filesystem::file_size(out / name) > 5000);
  const auto report = nlohmann::json::parse(std::ifstream(out / "report.json"));
  CHECK(report["characters"] == 12);
  CHECK(report["links"] > 0);
  CHECK(report["light"] == "sky");
  for (const char* stage : {"pose", "scene_update", "screen_space", "draw", "read"})
    CHECK(report["ms"][stage] > 0);
  const double all = mse_of(report, "all");
  CHECK(all > 0);
  CHECK(all < mse_of(report, "self_ground"));
  CHECK(all < mse_of(report, "self_links"));
  CHECK(mse_of(report, "self_ground") < mse_of(report, "self"));
  CHECK(mse_of(report, "self") < mse_of(report, "static"));
}

TEST_CASE("frames without a probe's light are another picture") {
  const std::filesystem::path out = CROWD_OUT "_plain";
  std::filesystem::remove_all(out);
  REQUIRE(
      run("--context egl --characters 6 --frames 1 --size 160x120 --no-sheets --no-light --out '" CROWD_OUT
          "_plain'") == 0);
  CHECK(nlohmann::json::parse(std::ifstream(out / "report.json"))["light"].is_null());
  CHECK(std::filesystem::file_size(out / "frame_0000.png") > 2000);
}

TEST_CASE("under a light, occlusion of each lobe is nearest to path tracing, AO alone farthest") {
  const std::filesystem::path out = CROWD_OUT "_light";
  std::filesystem::remove_all(out);
  std::filesystem::create_directories(out);
  // A bright side of the sky over a warm floor.
  constexpr int width = 32, height = 16;
  std::vector<float> rgb(3 * width * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float* texel = &rgb[3 * (y * width + x)];
      const bool bright = x >= 12 && x < 20 && y >= 3 && y < 8;
      texel[0] = y < 8 ? 0.4f : 0.5f;
      texel[1] = y < 8 ? 0.5f : 0.35f;
      texel[2] = y < 8 ? 0.7f : 0.2f;
      for (int c = 0; c < 3 && bright; ++c) texel[c] += 4;
    }
  const std::string map = (out / "side.hdr").string();
  const auto output = OIIO::ImageOutput::create(map);
  REQUIRE(output);
  REQUIRE(output->open(map, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT)));
  REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, rgb.data()));
  REQUIRE(output->close());
  REQUIRE(run("--characters 4 --frames 1 --size 320x240 --no-sheets --light '" + map + "' --out '" +
              out.string() + "'") == 0);
  CHECK(std::filesystem::file_size(out / "light_side.png") > 5000);
  const auto report = nlohmann::json::parse(std::ifstream(out / "report.json"));
  const double per_lobe = mse_of(report, "per_lobe"), times = mse_of(report, "ao_x_probe");
  CHECK(per_lobe > 0);
  CHECK(per_lobe < times);
  CHECK(times < mse_of(report, "ao_only"));
}

TEST_CASE("bad arguments end with code 2, a bad character with 3") {
  CHECK(run("--size 3 2> /dev/null") == 2);
  CHECK(run("--tier 40 2> /dev/null") == 2);
  CHECK(run("--screen-space maybe 2> /dev/null") == 2);
  CHECK(run("no_such_file.glb 2> /dev/null") == 2);
  CHECK(run("--light no_such_file.hdr 2> /dev/null") == 2);
  const std::filesystem::path broken = std::filesystem::temp_directory_path() / "crowd_test_broken.glb";
  std::ofstream(broken) << "not a character";
  CHECK(run(broken.string() + " 2> /dev/null") == 3);
  std::filesystem::remove(broken);
}
