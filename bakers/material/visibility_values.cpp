#include "bakers/material/visibility_values.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nook::bake::material {
namespace {

constexpr float far_away = 1e12f;

// Computes squared distances to the lower envelope of the parabolas f(q) + (p - q)^2 (Felzenszwalb and
// Huttenlocher 2012). The line repeats, so this handles three periods and writes the middle one.
void transform_line(const float* f, std::size_t n, std::size_t stride, float* out, std::vector<double>& bound,
                    std::vector<int>& parabola) {
  const int size = int(3 * n);
  const auto value = [&](int q) { return double(f[std::size_t(q) % n * stride]); };
  bound.resize(std::size_t(size) + 1);
  parabola.resize(std::size_t(size));
  int k = 0;
  parabola[0] = 0;
  bound[0] = -std::numeric_limits<double>::infinity();
  bound[1] = std::numeric_limits<double>::infinity();
  for (int q = 1; q < size; ++q) {
    double s;
    for (;;) {
      const int p = parabola[std::size_t(k)];
      s = ((value(q) + double(q) * q) - (value(p) + double(p) * p)) / (2.0 * (q - p));
      if (s > bound[std::size_t(k)]) break;
      --k;
    }
    ++k;
    parabola[std::size_t(k)] = q;
    bound[std::size_t(k)] = s;
    bound[std::size_t(k) + 1] = std::numeric_limits<double>::infinity();
  }
  k = 0;
  for (int q = int(n); q < int(2 * n); ++q) {
    while (bound[std::size_t(k) + 1] < q) ++k;
    const int p = parabola[std::size_t(k)];
    out[(std::size_t(q) - n) * stride] = float(value(p) + double(q - p) * (q - p));
  }
}

// For each texel, returns the squared distance, in texels, to the nearest texel of a class. Returns far_away
// if the class is empty.
std::vector<float> squared_distances(std::span<const float> mask, std::size_t width, std::size_t height,
                                     bool visible) {
  std::vector<float> d(mask.size()), out(mask.size());
  for (std::size_t i = 0; i < mask.size(); ++i) d[i] = (mask[i] > 0.5f) == visible ? 0 : far_away;
  std::vector<double> bound;
  std::vector<int> parabola;
  for (std::size_t x = 0; x < width; ++x)
    transform_line(&d[x * height], height, 1, &out[x * height], bound, parabola);
  for (std::size_t y = 0; y < height; ++y) transform_line(&out[y], width, height, &d[y], bound, parabola);
  return d;
}

}  // namespace

float saturated_distance(float distance_texels, std::uint32_t longer_side) {
  return std::tanh(distance_texels / (distance_scale * float(longer_side)));
}

std::vector<float> signed_distances(std::span<const float> masks, std::uint32_t width, std::uint32_t height) {
  const std::size_t texels = std::size_t(width) * height, views = masks.size() / texels;
  std::vector<float> distance(masks.size());
  tbb::parallel_for(std::size_t{0}, views, [&](std::size_t view) {
    const auto mask = masks.subspan(view * texels, texels);
    const auto to_visible = squared_distances(mask, width, height, true);
    const auto to_hidden = squared_distances(mask, width, height, false);
    for (std::size_t i = 0; i < texels; ++i) {
      const bool visible = mask[i] > 0.5f;
      // The boundary is half a texel before the nearest texel centre of the other class.
      const float d = std::sqrt(visible ? to_hidden[i] : to_visible[i]) - 0.5f;
      distance[view * texels + i] = saturated_distance(visible ? d : -d, std::max(width, height));
    }
  });
  return distance;
}

std::vector<float> margin_targets(std::span<const float> values, std::span<const float> decoded,
                                  float threshold) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const float value : values) nearest = std::min(nearest, std::abs(value - threshold));
  const float margin = 0.8f * nearest;
  std::vector<float> targets(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float side = values[i] > threshold ? 1.0f : -1.0f, most = 1.5f * std::abs(values[i] - threshold);
    const float reached = side * (decoded[i] - threshold);
    targets[i] = threshold + side * (reached >= margin ? std::min(reached, most) : 2 * margin - reached);
  }
  return targets;
}

}  // namespace nook::bake::material
