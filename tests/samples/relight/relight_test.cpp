// The sample as a user runs it, without a display: where the light of its room comes from.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace {

constexpr int width = 1280, height = 800;

int run(const std::string& arguments) {
  const std::string command = std::string("'" RELIGHT_SAMPLE "' ") + arguments;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<unsigned char> read_png(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  REQUIRE(input);
  REQUIRE(input->spec().width == width);
  REQUIRE(input->spec().height == height);
  std::vector<unsigned char> rgb(std::size_t(3) * width * height);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, rgb.data()));
  return rgb;
}

// The mean of a block of 16 x 16 pixels of a panel, the upper left one first.
std::array<double, 3> mean_at(const std::vector<unsigned char>& rgb, int panel, int x, int y) {
  std::array<double, 3> mean{};
  for (int i = 0; i < 256; ++i) {
    const int column = x + panel % 2 * width / 2 + i % 16, row = y + panel / 2 * height / 2 + i / 16;
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += rgb[3 * (std::size_t(row) * width + std::size_t(column)) + c] / 256.0;
  }
  return mean;
}

}  // namespace

TEST_CASE("the sun's light reaches what neither it nor the sky shines on") {
  const std::string picture = RELIGHT_OUT "/day.png";
  std::filesystem::remove(picture);
  REQUIRE(run("'" + picture + "' 16") == 0);
  const std::vector<unsigned char> rgb = read_png(picture);
  // The ceiling: the sun is above the horizon and the window below it, so that all of its light is reflected
  // once or more.
  for (int panel = 0; panel < 4; ++panel) {
    const auto ceiling = mean_at(rgb, panel, 320, 40);
    INFO("panel " << panel << ": " << ceiling[0] << " " << ceiling[1] << " " << ceiling[2]);
    CHECK(ceiling[0] > 40);
    // The sky is blue; what the floor reflects of the sun is not.
    CHECK(ceiling[0] > ceiling[2]);
  }
  // At noon more light comes in than in the morning, and the probes follow.
  CHECK(mean_at(rgb, 2, 320, 40)[1] > mean_at(rgb, 0, 320, 40)[1] + 15);
}

TEST_CASE("relight refuses a missing picture and a day of three frames") {
  CHECK(run("2> '" RELIGHT_OUT "/usage.txt'") == 2);
  CHECK(run("day.png 3 2> '" RELIGHT_OUT "/usage.txt'") == 2);
}
