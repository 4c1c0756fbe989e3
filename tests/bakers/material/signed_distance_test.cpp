#include "bakers/material/visibility_values.h"

#include <algorithm>
#include <cmath>

#include "bakers/raytrace/hemisphere.h"
#include "tests/catch.h"

using namespace nook::bake;
using namespace nook::bake::material;

namespace {

// By looking at all texels of all neighbouring tiles.
float slow_distance(const std::vector<float>& mask, int width, int height, int x, int y) {
  const bool visible = mask[std::size_t(x * height + y)] > 0.5f;
  float nearest = 1e9f;
  for (int i = -width; i < 2 * width; ++i)
    for (int j = -height; j < 2 * height; ++j) {
      const bool other = mask[std::size_t((i + width) % width * height + (j + height) % height)] > 0.5f;
      if (other != visible) nearest = std::min(nearest, std::hypot(float(i - x), float(j - y)));
    }
  const float scale = distance_scale * float(std::max(width, height));
  return std::tanh((nearest - 0.5f) / scale) * (visible ? 1 : -1);
}

}  // namespace

TEST_CASE("signed distances equal a search over all texels, across the tile's border") {
  constexpr int width = 40, height = 24;
  for (const int share : {50, 10, 1}) {
    std::vector<float> mask(width * height);
    for (std::size_t i = 0; i < mask.size(); ++i)
      mask[i] = mix_bits(i) % 100 < std::uint64_t(share) ? 1.0f : 0.0f;
    const std::vector<float> distance = signed_distances(mask, width, height);
    for (int x = 0; x < width; ++x)
      for (int y = 0; y < height; ++y)
        REQUIRE(distance[std::size_t(x * height + y)] ==
                Approx(slow_distance(mask, width, height, x, y)).margin(1e-5));
  }
}

TEST_CASE("distances keep the mask in their sign, and masks without a boundary are 1 or -1") {
  std::vector<float> masks(3 * 64, 1.0f);
  std::fill_n(masks.begin() + 64, 64, 0.0f);
  masks[2 * 64 + 20] = 0;
  const std::vector<float> distance = signed_distances(masks, 8, 8);
  for (std::size_t i = 0; i < masks.size(); ++i) CHECK((distance[i] > 0) == (masks[i] > 0.5f));
  CHECK(distance[5] == 1);
  CHECK(distance[64 + 5] == -1);
}
