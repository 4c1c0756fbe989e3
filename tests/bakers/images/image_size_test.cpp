#include "bakers/images/image_files.h"

#include <climits>

#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

TEST_CASE("an image's size fits its limit and its file") {
  CHECK_NOTHROW(check_image_size("it", 1, 1, 1, 1));
  CHECK_NOTHROW(check_image_size("it", 4096, 4096, std::size_t{1} << 24, 1 << 10));
  CHECK_THROWS_AS(check_image_size("it", 4097, 4096, std::size_t{1} << 24, 1 << 20), Failure);
  CHECK_THROWS_AS(check_image_size("it", 4096, 4096, std::size_t{1} << 24, (1 << 10) - 1), Failure);
  CHECK_THROWS_AS(check_image_size("it", 0, 5, 100, 100), Failure);
  CHECK_THROWS_AS(check_image_size("it", 5, -1, 100, 100), Failure);
  CHECK_THROWS_AS(check_image_size("it", INT_MAX, INT_MAX, std::size_t{1} << 26, UINTMAX_MAX), Failure);
}
