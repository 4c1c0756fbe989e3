#include "sdk/src/probe/probe_file.h"

#include <cmath>

#include "tests/catch.h"

using namespace nook;
using namespace nook::probe;

TEST_CASE("RGB9E5 keeps its stated error over its whole range") {
  std::uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return float(state >> 8) / 16777216.0f;
  };
  for (int i = 0; i < 100000; ++i) {
    const float size = std::exp2(-30 + 45.9f * random());
    const Vec3 v{size * random(), size * random(), size * random()};
    const Vec3 back = from_rgb9e5(to_rgb9e5(v));
    const float largest = std::fmax(v.x, std::fmax(v.y, v.z));
    const float bound = std::fmax(0x1p-9f * largest, 0x1p-25f);
    REQUIRE(std::abs(back.x - v.x) <= bound);
    REQUIRE(std::abs(back.y - v.y) <= bound);
    REQUIRE(std::abs(back.z - v.z) <= bound);
    REQUIRE(to_rgb9e5(back) == to_rgb9e5(from_rgb9e5(to_rgb9e5(back))));
  }
}

TEST_CASE("RGB9E5 has the bits of GL_RGB9_E5") {
  CHECK(to_rgb9e5({0, 0, 0}) == 0);
  // 1 = 256 / 512 * 2^1: exponent 1 + 15.
  CHECK(to_rgb9e5({1, 0, 0}) == (16u << 27 | 256u));
  CHECK(to_rgb9e5({0, 1, 0}) == (16u << 27 | 256u << 9));
  CHECK(to_rgb9e5({0, 0, 0.5f}) == (15u << 27 | 256u << 18));
  CHECK(from_rgb9e5(0xffffffffu).x == max_rgb9e5);
  CHECK(to_rgb9e5({max_rgb9e5, max_rgb9e5, max_rgb9e5}) == 0xffffffffu);
  // Rounding that carries into the exponent.
  CHECK(from_rgb9e5(to_rgb9e5({511.9f, 0, 0})).x == 512);
}

TEST_CASE("RGB9E5 clamps what it cannot hold") {
  CHECK(from_rgb9e5(to_rgb9e5({-3, 2, NAN})).x == 0);
  CHECK(from_rgb9e5(to_rgb9e5({-3, 2, NAN})).y == 2);
  CHECK(from_rgb9e5(to_rgb9e5({-3, 2, NAN})).z == 0);
  CHECK(from_rgb9e5(to_rgb9e5({1e30f, 0, INFINITY})).x == max_rgb9e5);
}
