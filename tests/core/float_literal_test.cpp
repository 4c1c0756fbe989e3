#include "sdk/src/core/floats.h"

#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

#include "tests/catch.h"

using namespace nook;

TEST_CASE("literals of shaders are the shortest that give the float") {
  const auto text = [](float value) { return std::string(float_literal(value).text); };
  CHECK(text(0.f) == "0e+00");
  CHECK(text(-0.f) == "-0e+00");
  CHECK(text(1.f) == "1e+00");
  CHECK(text(-0.15f) == "-1.5e-01");
  CHECK(text(0.1f) == "1e-01");
  CHECK(text(1.f / 3) == "3.3333334e-01");
  CHECK(text(123456789.f) == "1.2345679e+08");
  CHECK(text(std::numeric_limits<float>::max()) == "3.4028235e+38");
  CHECK(text(std::numeric_limits<float>::min()) == "1.1754944e-38");
  CHECK(text(std::numeric_limits<float>::denorm_min()) == "1e-45");
  // The nearest decimal of 8 digits, 1.2621774e-29, is read as the float below this power of two.
  CHECK(text(0x1p-96f) == "1.2621775e-29");
}

#ifdef __cpp_lib_to_chars
TEST_CASE("literals of shaders are the text of std::to_chars") {
  std::uint32_t wrong = 0;
  const auto compare = [&](std::uint32_t bits) {
    const auto value = bit_cast<float>(bits);
    char expected[32]{};
    std::to_chars(expected, expected + sizeof expected - 1, value, std::chars_format::scientific);
    if (std::string(expected) == float_literal(value).text) return;
    if (++wrong == 1) FAIL_CHECK(expected << " is written as " << float_literal(value).text);
  };
  // The neighbours of each power of two, where the gap between floats changes, of both signs.
  for (std::uint32_t field = 0; field < 255; ++field)
    for (std::uint32_t i = 0; i < 8; ++i) {
      compare(field << 23 | i);
      compare(field << 23 | 0x80000000 | i);
      compare(field << 23 | (0x7fffff - i));
    }
  // The whole range, by a prime step.
  for (std::uint32_t bits = 0; bits < 0x7f800000; bits += 30011) compare(bits);
  // Ties between two decimals of the same length: whole numbers beyond 2^24.
  for (std::uint32_t i = 0; i < 4000; ++i) compare(bit_cast<std::uint32_t>(16777216.f + 2.f * float(i)));
  CHECK(wrong == 0);
}
#endif
