#include "sdk/src/material/spatial_modes.h"

#include <cmath>
#include <numeric>

#include "tests/catch.h"
#include "tests/material/equation.h"
#include "tests/material/material_sample.h"

using namespace nook::material;

TEST_CASE("expanded modes are the core times both bases, and below their bound") {
  // Neither, one and both spatial modes at full rank.
  for (const test::SampleSize& size :
       {test::SampleSize{.rank_x = 3, .rank_y = 2}, test::SampleSize{.rank_x = 6, .rank_y = 2},
        test::SampleSize{.rank_x = 3, .rank_y = 4}, test::SampleSize{.rank_x = 6, .rank_y = 4}}) {
    const Material material = test::sample_material(5, size);
    const ClusteredTensor& t = material.btf;
    for (std::uint32_t c = 0; c < t.shape.clusters; ++c) {
      const ModeExpansion expansion(t, c, nook::default_memory());
      std::vector<float> scratch(expansion.scratch_size()),
          image(std::size_t(t.shape.width) * t.shape.height);
      for (std::uint32_t a = 0; a < t.shape.rank_light; ++a)
        for (std::uint32_t b = 0; b < t.shape.rank_view; ++b) {
          expansion.expand(a, b, scratch, image);
          for (std::uint32_t y = 0; y < t.shape.height; ++y)
            for (std::uint32_t x = 0; x < t.shape.width; ++x) {
              const float got = image[y * t.shape.width + x];
              // 24 products of numbers below 1 in float.
              CHECK(std::abs(got - test::spatial_mode(t, c, a, b, x, y)) < 24e-7);
              CHECK(std::abs(got) <= expansion.bound() * 1.000001f);
            }
        }
    }
  }
}

TEST_CASE("every level keeps the mean of the image") {
  for (const auto& [width, height] :
       {std::pair{8u, 8u}, {12u, 4u}, {7u, 5u}, {96u, 3u}, {1u, 9u}, {3u, 1u}}) {
    test::Numbers numbers(3);
    std::vector<float> image(std::size_t(width) * height);
    for (float& texel : image) texel = numbers.between(0, 1);
    const double mean = std::accumulate(image.begin(), image.end(), 0.0) / double(image.size());
    std::uint32_t w = width, h = height;
    for (std::uint32_t level = 1; level < level_count(width, height); ++level) {
      std::vector<float> smaller(std::size_t(level_size(width, level)) * level_size(height, level));
      halve(image, w, h, smaller);
      w = level_size(width, level);
      h = level_size(height, level);
      CHECK(std::abs(std::accumulate(smaller.begin(), smaller.end(), 0.0) / double(smaller.size()) - mean) <
            1e-6);
      image = smaller;
    }
    CHECK(image.size() == 1);
  }
}

TEST_CASE("a texel of the next level is the mean of its area") {
  // Five texels into two: each covers two and a half.
  std::vector<float> smaller(2);
  halve(std::vector<float>{1, 2, 3, 4, 5}, 5, 1, smaller);
  CHECK(std::abs(smaller[0] - (1 + 2 + 0.5f * 3) / 2.5f) < 1e-6f);
  CHECK(std::abs(smaller[1] - (0.5f * 3 + 4 + 5) / 2.5f) < 1e-6f);
  std::vector<float> quarter(1);
  halve(std::vector<float>{1, 2, 3, 6}, 2, 2, quarter);
  CHECK(quarter[0] == 3);
}
