// The sample as a user runs it, without a display: the shape's own shadows are on the left.

#include <string>
#include <vector>

#include "tests/catch.h"
#include "tests/samples/sample_run.h"

namespace {

constexpr int width = 1280, height = 480;

}  // namespace

TEST_CASE("the transfer sample darkens its left half where the shape hides the light") {
  const std::string material = TRANSFER_OUT "/weave.nook", picture = TRANSFER_OUT "/transfer.png";
  REQUIRE(nook::test::exit_code("'" OPEN_WEAVE "' '" + material + "' none") == 0);
  REQUIRE(nook::test::exit_code("'" TRANSFER_SAMPLE "' '" + material + "' '" + picture + "'") == 0);
  const auto shown = nook::test::read_picture<unsigned char>(picture, width, height);
  double sum[2] = {};
  int darker = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width / 2; ++x) {
      const unsigned char* const left = &shown.at(x, y);
      const unsigned char* const right = &shown.at(x + width / 2, y);
      sum[0] += left[0] + left[1] + left[2];
      sum[1] += right[0] + right[1] + right[2];
      darker += left[1] + 20 < right[1];
    }
  // Lobes ring a little where they change, so that single pixels may be brighter.
  CHECK(sum[0] < 0.98 * sum[1]);
  CHECK(darker > 2000);
}

TEST_CASE("the transfer sample names a file that it cannot read") {
  CHECK(nook::test::exit_code("'" TRANSFER_SAMPLE "' '" TRANSFER_OUT "/no file.nook' out.png 2>/dev/null") ==
        3);
  CHECK(nook::test::exit_code("'" TRANSFER_SAMPLE "' 2>/dev/null") == 2);
}
