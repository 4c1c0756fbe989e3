// The sample as a user runs it, without a display: the shape's own shadows are on the left.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace {

constexpr int width = 1280, height = 480;

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("the transfer sample darkens its left half where the shape hides the light") {
  const std::string material = TRANSFER_OUT "/weave.nook", picture = TRANSFER_OUT "/transfer.png";
  REQUIRE(run("'" OPEN_WEAVE "' '" + material + "' none") == 0);
  REQUIRE(run("'" TRANSFER_SAMPLE "' '" + material + "' '" + picture + "'") == 0);
  const auto input = OIIO::ImageInput::open(picture);
  REQUIRE(input);
  REQUIRE(input->spec().width == width);
  REQUIRE(input->spec().height == height);
  std::vector<unsigned char> rgb(std::size_t(3) * width * height);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, rgb.data()));
  double sum[2] = {};
  int darker = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width / 2; ++x) {
      const unsigned char* const left = &rgb[std::size_t(3) * (std::size_t(y) * width + std::size_t(x))];
      const unsigned char* const right = left + std::size_t(3) * (width / 2);
      sum[0] += left[0] + left[1] + left[2];
      sum[1] += right[0] + right[1] + right[2];
      darker += left[1] + 20 < right[1];
    }
  // Lobes ring a little where they change, so that single pixels may be brighter.
  CHECK(sum[0] < 0.98 * sum[1]);
  CHECK(darker > 2000);
}

TEST_CASE("the transfer sample names a file that it cannot read") {
  CHECK(run("'" TRANSFER_SAMPLE "' '" TRANSFER_OUT "/no file.nook' out.png 2>/dev/null") == 3);
  CHECK(run("'" TRANSFER_SAMPLE "' 2>/dev/null") == 2);
}
