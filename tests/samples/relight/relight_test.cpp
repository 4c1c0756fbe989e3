// The sample as a user runs it, without a display: where the light of its room comes from.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/samples/sample_run.h"

namespace {

constexpr int width = 1280, height = 800;

using Picture = nook::test::SamplePicture<unsigned char>;

int run(const std::string& arguments) {
  return nook::test::exit_code(nook::test::quoted(RELIGHT_SAMPLE) + " " + arguments);
}

// The mean of a block of 16 x 16 pixels of a panel, the upper left one first.
std::array<double, 3> mean_at(const Picture& picture, int panel, int x, int y) {
  std::array<double, 3> mean{};
  for (int i = 0; i < 256; ++i) {
    const int column = x + panel % 2 * width / 2 + i % 16, row = y + panel / 2 * height / 2 + i / 16;
    for (std::size_t c = 0; c < 3; ++c) mean[c] += (&picture.at(column, row))[c] / 256.0;
  }
  return mean;
}

}  // namespace

TEST_CASE("the sun's light reaches what neither it nor the sky shines on") {
  const std::string picture = RELIGHT_OUT "/day.png";
  std::filesystem::remove(picture);
  REQUIRE(run("'" + picture + "' 16") == 0);
  const Picture shown = nook::test::read_picture<unsigned char>(picture, width, height);
  // The ceiling: the sun is above the horizon and the window below it, so that all of its light is reflected
  // once or more.
  for (int panel = 0; panel < 4; ++panel) {
    const auto ceiling = mean_at(shown, panel, 320, 40);
    INFO("panel " << panel << ": " << ceiling[0] << " " << ceiling[1] << " " << ceiling[2]);
    CHECK(ceiling[0] > 40);
    // The sky is blue; what the floor reflects of the sun is not.
    CHECK(ceiling[0] > ceiling[2]);
  }
  // At noon more light comes in than in the morning, and the probes follow.
  CHECK(mean_at(shown, 2, 320, 40)[1] > mean_at(shown, 0, 320, 40)[1] + 15);
}

TEST_CASE("relight refuses a missing picture and a day of three frames") {
  CHECK(run("2> '" RELIGHT_OUT "/usage.txt'") == 2);
  CHECK(run("day.png 3 2> '" RELIGHT_OUT "/usage.txt'") == 2);
}
