#include "bakers/material/fill_gaps.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

struct Size {
  std::size_t width = 1, height = 1;
  std::size_t texels() const { return width * height; }
  Size halved() const { return {(width + 1) / 2, (height + 1) / 2}; }
};

// Level 0 first; y fastest, as in RawMaterial.
using Levels = std::vector<std::vector<float>>;

std::vector<Size> sizes_of(Size size) {
  std::vector<Size> sizes{size};
  while (sizes.back().texels() > 1) sizes.push_back(sizes.back().halved());
  return sizes;
}

// Each level the sums of 2 x 2 texels of the one before.
void pull(const std::vector<Size>& sizes, Levels& levels) {
  levels.resize(sizes.size());
  for (std::size_t l = 1; l < sizes.size(); ++l) {
    const Size fine = sizes[l - 1], coarse = sizes[l];
    levels[l].assign(coarse.texels(), 0.0f);
    for (std::size_t x = 0; x < fine.width; ++x)
      for (std::size_t y = 0; y < fine.height; ++y)
        levels[l][x / 2 * coarse.height + y / 2] += levels[l - 1][x * fine.height + y];
  }
}

// The texel of the coarser level that lies on the other side of a texel, the nearer one being at / 2.
std::size_t beside(std::size_t at, std::size_t size) {
  return (at / 2 + (at % 2 ? 1 : size - 1)) % size;
}

// Sums become means; empty texels take the coarser level's value, linear between its texels.
void push(const std::vector<Size>& sizes, const Levels& weights, Levels& levels) {
  for (std::size_t l = sizes.size(); l-- > 0;) {
    const Size fine = sizes[l];
    for (std::size_t x = 0; x < fine.width; ++x)
      for (std::size_t y = 0; y < fine.height; ++y) {
        float& value = levels[l][x * fine.height + y];
        const float weight = weights[l][x * fine.height + y];
        if (weight > 0) {
          value /= weight;
        } else if (l + 1 < sizes.size()) {
          const Size coarse = sizes[l + 1];
          const std::size_t near_x = x / 2 * coarse.height, far_x = beside(x, coarse.width) * coarse.height;
          const std::size_t near_y = y / 2, far_y = beside(y, coarse.height);
          const std::vector<float>& from = levels[l + 1];
          value = (9 * from[near_x + near_y] + 3 * (from[far_x + near_y] + from[near_x + far_y]) +
                   from[far_x + far_y]) /
                  16;
        }
      }
  }
}

Levels pulled_weights(const std::vector<Size>& sizes, std::span<const float> coverage) {
  Levels weights(1);
  weights[0].assign(coverage.begin(), coverage.end());
  pull(sizes, weights);
  return weights;
}

void fill_image(const std::vector<Size>& sizes, const Levels& weights, float* image) {
  Levels levels(1);
  levels[0].resize(sizes[0].texels());
  for (std::size_t i = 0; i < levels[0].size(); ++i) levels[0][i] = weights[0][i] > 0 ? image[i] : 0;
  pull(sizes, levels);
  push(sizes, weights, levels);
  std::ranges::copy(levels[0], image);
}

}  // namespace

void fill_gaps(RawMaterial& raw, std::span<const float> coverage) {
  const std::size_t views = raw.views.size(), texels = raw.texels();
  if (coverage.size() != views * texels)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "coverage of %zu texels, of %zu views there are %zu",
                  coverage.size(), views, views * texels);
  const std::vector<Size> sizes = sizes_of({raw.width, raw.height});
  for (std::size_t view = 0; view < views; ++view) {
    const std::span<const float> own = coverage.subspan(view * texels, texels);
    if (std::ranges::all_of(own, [](float share) { return share == 1; })) continue;
    const Levels weights = pulled_weights(sizes, own);
    tbb::parallel_for(std::size_t{0}, raw.light_rows(), [&](std::size_t row) {
      fill_image(sizes, weights, &raw.btf[(row * views + view) * texels]);
    });
  }
}

void fill_image_gaps(std::span<float> image, std::span<const float> coverage, std::uint32_t width,
                     std::uint32_t height) {
  const std::vector<Size> sizes = sizes_of({width, height});
  fill_image(sizes, pulled_weights(sizes, coverage), image.data());
}

}  // namespace nook::bake::material
