#include "sdk/src/core/checks.h"

#include <cstdint>
#include <limits>

#include "tests/catch.h"

using namespace nook;

TEST_CASE("checks of ranges take both ends and name what is outside") {
  check_range("steps", std::uint32_t{1}, 1, 64);
  check_range("steps", std::uint32_t{64}, 1, 64);
  CHECK_THROWS_WITH(check_range("steps", std::uint32_t{0}, 1, 64),
                    "steps is out of range (got 0, need 1 to 64)");
  CHECK_THROWS_WITH(check_range("steps", std::uint32_t{65}, 1, 64),
                    "steps is out of range (got 65, need 1 to 64)");
  CHECK_THROWS_WITH(check_range("share", 1.5f, 0, 0.25f), "share is out of range (got 1.5, need 0 to 0.25)");
  CHECK_THROWS_AS(check_range("share", std::numeric_limits<float>::quiet_NaN(), 0, 1), Failure);
}

TEST_CASE("checks print the ends of every type of number") {
  CHECK_THROWS_WITH(check_range("n", std::numeric_limits<std::int64_t>::min(), -1, 1),
                    "n is out of range (got -9223372036854775808, need -1 to 1)");
  CHECK_THROWS_WITH(check_range("n", std::numeric_limits<std::uint64_t>::max(), 0, 1),
                    "n is out of range (got 18446744073709551615, need 0 to 1)");
  CHECK_THROWS_WITH(check_range("n", std::numeric_limits<float>::lowest(), 0, 1),
                    "n is out of range (got -3.40282e+38, need 0 to 1)");
}

TEST_CASE("checks in words refuse floats that are not finite") {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  check_fits("radius", 2.0f, true, "metres above 0");
  CHECK_THROWS_WITH(check_fits("radius", -2.0f, false, "metres above 0"),
                    "radius is out of range (got -2, need metres above 0)");
  CHECK_THROWS_WITH(check_fits("radius", infinity, infinity > 0, "metres above 0"),
                    "radius is out of range (got inf, need metres above 0)");
  CHECK_THROWS_AS(check_fits("radius", -infinity, true, "a number"), Failure);
}

TEST_CASE("checks of indices, enumerators, limits and switches name the value and the need") {
  check_index("skin", 2, 3);
  CHECK_THROWS_WITH(check_index("skin", 3, 3), "skin is out of range (got 3, need less than 3)");
  check_known("format", 0, 2);
  check_known("format", 2, 2);
  CHECK_THROWS_WITH(check_known("format", 3, 2), "format is unknown (got 3, need 0 to 2)");
  CHECK_THROWS_WITH(check_known("format", -1, 2), "format is unknown (got -1, need 0 to 2)");
  check_at_most("threads", 4, 4);
  CHECK_THROWS_WITH(check_at_most("threads", 5, 4), "threads is out of range (got 5, need at most 4)");
  check_switch("timers", 1);
  CHECK_THROWS_WITH(check_switch("timers", 2), "timers is neither on nor off (got 2, need 0 or 1)");
}

TEST_CASE("checks carry the result that their caller names") {
  try {
    check_range("lobes", std::uint32_t{9}, 1, 4, NOOK_ERROR_BAD_FILE);
    FAIL("nothing was thrown");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
  }
}

TEST_CASE("strides are checked by what they reach") {
  CHECK(checked_stride("stride", 0, 10, 12) == 12);
  CHECK(checked_stride("stride", 16, 10, 12) == 16);
  CHECK(checked_stride("stride", SIZE_MAX, 0, 12) == SIZE_MAX);  // of nothing
  CHECK(checked_stride("stride", PTRDIFF_MAX / 10, 10, 12) == PTRDIFF_MAX / 10);
  CHECK_THROWS_WITH(checked_stride("stride", 11, 10, 12),
                    "stride is too small (got 11 bytes, need 0 or at least 12)");
  CHECK_THROWS_AS(checked_stride("stride", PTRDIFF_MAX / 10 + 1, 10, 12), Failure);
  CHECK_THROWS_AS(checked_stride("stride", SIZE_MAX, 1, 12), Failure);
  CHECK_THROWS_AS(checked_stride("stride", SIZE_MAX, SIZE_MAX, 12), Failure);
  check_array("count", PTRDIFF_MAX / 12, 12);
  CHECK_THROWS_AS(check_array("count", PTRDIFF_MAX / 12 + 1, 12), Failure);
}
