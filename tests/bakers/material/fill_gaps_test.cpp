#include "bakers/material/raw_material.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "bakers/raytrace/hemisphere.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;

namespace {

// One light, so three rows; values of `colour(row, view, x, y)`.
template <class Colour>
RawMaterial raw_of(std::uint32_t views, std::uint32_t width, std::uint32_t height, const Colour& colour) {
  RawMaterial raw;
  raw.lights = {{0, 0, 1}};
  raw.views.assign(views, {0, 0, 1});
  raw.width = width;
  raw.height = height;
  for (std::uint32_t row = 0; row < 3; ++row)
    for (std::uint32_t v = 0; v < views; ++v)
      for (std::uint32_t x = 0; x < width; ++x)
        for (std::uint32_t y = 0; y < height; ++y) raw.btf.push_back(colour(row, v, x, y));
  return raw;
}

std::vector<float> random_coverage(std::size_t size, std::uint64_t open_percent) {
  std::vector<float> coverage(size);
  for (std::size_t i = 0; i < size; ++i)
    coverage[i] = mix_bits(i) % 100 < open_percent ? 0 : float(1 + mix_bits(i + size) % 4) / 4;
  return coverage;
}

}  // namespace

TEST_CASE("a colour that is everywhere the same fills every gap, whatever lay there") {
  // Sides that do not halve evenly, and nearly empty textures.
  for (const std::uint64_t open : {10, 60, 97}) {
    const std::vector<float> coverage = random_coverage(2 * 13 * 6, open);
    std::size_t at = 0;
    RawMaterial raw = raw_of(2, 13, 6, [&](std::uint32_t row, auto...) {
      const float share = coverage[at++ % coverage.size()];
      return share > 0 ? share * float(row + 1) : 1e30f;
    });
    fill_gaps(raw, coverage);
    const std::size_t each = raw.btf.size() / 3;
    // Sums of some tens of numbers, of 24 bits.
    for (std::size_t i = 0; i < raw.btf.size(); ++i)
      REQUIRE(raw.btf[i] == Approx(float(i / each + 1)).epsilon(1e-5));
  }
}

TEST_CASE("what is met keeps its colour, a whole texel to the bit and a part without its share") {
  const std::vector<float> coverage = random_coverage(std::size_t{16} * 16, 40);
  const auto colour = [](std::size_t i) { return 0.1f + float(mix_bits(7 * i) % 1000) / 1000; };
  std::size_t at = 0;
  RawMaterial raw = raw_of(1, 16, 16, [&](auto...) {
    const std::size_t i = at++;
    return colour(i) * coverage[i % coverage.size()];
  });
  fill_gaps(raw, coverage);
  for (std::size_t i = 0; i < raw.btf.size(); ++i) {
    const float share = coverage[i % coverage.size()];
    if (share == 1) REQUIRE(raw.btf[i] == colour(i));
    if (share > 0) REQUIRE(raw.btf[i] == Approx(colour(i)).epsilon(1e-6));
  }
}

TEST_CASE("a gap lies between the colours round it, across the tile's border, and keeps the mean") {
  // Two stripes, at x = 2 and x = 6 of 8, of colours 1 and 3: the gap across the border is theirs too.
  std::vector<float> coverage(64, 0.0f);
  for (std::size_t y = 0; y < 8; ++y) coverage[2 * 8 + y] = coverage[6 * 8 + y] = 1;
  RawMaterial raw = raw_of(
      1, 8, 8, [&](std::uint32_t, std::uint32_t, std::uint32_t x, auto) { return x == 2 ? 1.0f : 3.0f; });
  fill_gaps(raw, coverage);
  const auto at = [&](std::size_t x) { return raw.btf[x * 8 + 3]; };
  // Nearer to what is nearer, on both sides of either stripe.
  CHECK((1 < at(3) && at(3) < at(4) && at(4) < at(5) && at(5) < 3));
  CHECK((3 > at(7) && at(7) > at(0) && at(0) > at(1) && at(1) > 1));
  double sum = 0;
  for (std::size_t x = 0; x < 8; ++x) sum += double(at(x));
  // Half a tile further the colours are exchanged and all else is the same.
  CHECK(sum / 8 == Approx(2).margin(1e-6));
}

TEST_CASE("a view that meets nothing is black, and others are left alone") {
  std::vector<float> coverage(3 * 16, 1.0f);
  std::fill_n(coverage.begin() + 16, 16, 0.0f);
  RawMaterial raw = raw_of(3, 4, 4, [](auto...) { return 0.5f; });
  fill_gaps(raw, coverage);
  for (std::size_t i = 0; i < raw.btf.size(); ++i) CHECK(raw.btf[i] == (i / 16 % 3 == 1 ? 0 : 0.5f));
  CHECK_THROWS_AS(fill_gaps(raw, std::span(coverage).first(16)), Failure);
}

TEST_CASE("gaps are filled with the same bits on one thread and on four") {
  const std::vector<float> coverage = random_coverage(std::size_t{4} * 20 * 12, 50);
  const auto filled = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::size_t at = 0;
    RawMaterial raw = raw_of(4, 20, 12, [&](auto...) { return float(mix_bits(at++) % 1000); });
    fill_gaps(raw, coverage);
    return raw.btf;
  };
  CHECK(filled(1) == filled(4));
}
