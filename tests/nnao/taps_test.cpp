#include "sdk/src/nnao/taps.h"

#include <set>

#include "tests/catch.h"

using namespace nook::nnao;

TEST_CASE("a block of 3 x 3 pixels, wherever it begins, has one noise value in each ninth") {
  for (std::uint32_t corner = 0; corner < 9; ++corner) {
    std::set<int> rotations, offsets;
    for (std::uint32_t i = 0; i < 9; ++i) {
      const TapNoise noise = tap_noise(corner % 3 + i % 3, corner / 3 + i / 3);
      rotations.insert(int(9 * noise.rotation));
      offsets.insert(int(9 * noise.offset));
    }
    CHECK(rotations == std::set<int>{0, 1, 2, 3, 4, 5, 6, 7, 8});
    CHECK(offsets == rotations);
  }
}

TEST_CASE("the place within a ninth is even, and neighbours tell nothing of each other") {
  constexpr std::uint32_t size = 96;
  // Returns the mean of the product of two deviations from 1/2, over the variance 1/12 of an even
  // distribution.
  const auto correlation = [](auto first, auto second) {
    double sum = 0;
    for (std::uint32_t y = 0; y < size; ++y)
      for (std::uint32_t x = 0; x < size; ++x) sum += (first(x, y) - 0.5) * (second(x, y) - 0.5);
    return 12 * sum / (size * size);
  };
  const auto rotation = [](int right, int up) {
    return [=](std::uint32_t x, std::uint32_t y) {
      return double(tap_jitter(x + std::uint32_t(right), y + std::uint32_t(up)).rotation);
    };
  };
  const auto offset = [](std::uint32_t x, std::uint32_t y) { return double(tap_jitter(x, y).offset); };
  // Of 9,216 independent pairs, the correlation has a deviation of 1/96. The bounds are four of these.
  constexpr double four_deviations = 4.0 / size;
  CHECK(std::abs(correlation(rotation(0, 0), rotation(0, 0)) - 1) < four_deviations);
  CHECK(std::abs(correlation(offset, offset) - 1) < four_deviations);
  CHECK(std::abs(correlation(rotation(0, 0), offset)) < four_deviations);
  for (int up = 0; up <= 4; ++up)
    for (int right = up == 0 ? 1 : 0; right <= 4; ++right)
      CHECK(std::abs(correlation(rotation(0, 0), rotation(right, up))) < four_deviations);
}

TEST_CASE("steps grow, never share a pixel and stay within the radius") {
  for (const std::uint32_t taps : {9u, 16u, 32u, 64u, 128u, 256u}) {
    const TapGrid grid = horizon_grid(taps);
    REQUIRE(grid.directions * grid.steps == taps);
    for (std::uint32_t rank = 0; rank < 9; ++rank)
      for (const float radius_px : {0.5f, 3.0f, 40.0f, 300.0f}) {
        float before = 0;
        for (std::uint32_t s = 0; s < grid.steps; ++s) {
          const float distance = step_distance_px(s, grid.steps, tap_noise_of_rank(rank), radius_px);
          CHECK(distance >= before + (radius_px < 1 ? 1 : 0));
          CHECK(distance >= float(s + 1));
          CHECK(distance <= std::max(radius_px, float(s + 1)));
          before = distance;
        }
      }
  }
  CHECK(horizon_grid(48).steps == 0);
}

TEST_CASE("a direction keeps its angle in view space where pixels are not square or the screen is flipped") {
  const TapOffset tap = horizon_tap(0.6f, 0.8f, 10, {20, -10});
  // Back in metres: along (0.6, 0.8).
  CHECK(std::abs(tap.x_px / 20 / (tap.y_px / -10) - 0.75f) < 1e-5f);
  CHECK(std::abs(tap.y_px - -8) < 1e-5f);
}

TEST_CASE("a subset of the grid is one cell of every stratum; the whole grid is itself") {
  constexpr std::uint32_t cells = 961;
  for (const std::uint32_t taps : {16u, 64u, 100u, 256u})
    for (std::uint32_t rank = 0; rank < 9; ++rank)
      for (std::uint32_t t = 0; t < taps; ++t) {
        const std::uint32_t cell = paper_tap_cell(t, taps, tap_noise_of_rank(rank));
        // One more or less, for the stratum's ends lie between cells.
        CHECK(double(cell) >= double(t) * cells / taps - 1);
        CHECK(double(cell) < double(t + 1) * cells / taps + 1);
      }
  for (std::uint32_t t = 0; t < cells; ++t) CHECK(paper_tap_cell(t, cells, tap_noise_of_rank(5)) == t);
  const TapOffset centre = paper_tap(480, cells, {}, 2, {10, 10});
  CHECK(std::abs(centre.x_px) < 1e-4f);
  const TapOffset corner = paper_tap(0, cells, {}, 2, {10, 10});
  // Half a cell inside of the corner of a square of 4 m, 10 pixels a metre.
  CHECK(std::abs(corner.x_px + 20 * 30.0f / 31) < 1e-4f);
}
