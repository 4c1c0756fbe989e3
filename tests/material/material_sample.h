// Small materials of random numbers, for tests that need no bake.
#pragma once

#include <cmath>
#include <cstdint>

#include "sdk/src/core/floats.h"
#include "sdk/src/material/material.h"

namespace nook::material::test {

// Reproducible numbers on every platform (Numerical Recipes' linear congruential generator).
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : state_(seed) {}
  std::uint32_t next() { return state_ = state_ * 1664525u + 1013904223u; }
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(next() >> 8) / 16777216.0f;
  }
  std::uint32_t below(std::uint32_t count) { return (next() >> 8) % count; }

 private:
  std::uint32_t state_;
};

// Evenly spread over the hemisphere (a Fibonacci spiral), the first near the normal.
inline Vector<Vec3> hemisphere(std::uint32_t count) {
  Vector<Vec3> directions;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float z = 1 - (float(i) + 0.5f) / float(count), r = std::sqrt(1 - z * z),
                phi = 2.3999632f * float(i);
    directions.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  return directions;
}

struct SampleSize {
  std::uint32_t lights = 5, views = 9, width = 6, height = 4;
  std::uint32_t rank_light = 4, rank_view = 4, rank_x = 3, rank_y = 4;
  std::uint32_t clusters = 3, mixture = 2;
  std::uint32_t map_side = 0;
  VisibilityForm visibility = VisibilityForm::distance;
  std::uint32_t bits = 16;
  float relief_height = 0;         // tiles; 0: no relief
  std::uint32_t relief_steps = 0;  // 0: a plane
  std::uint32_t channels = 0;      // of a neural material; 0: a tensor
  std::uint32_t units = 8, layers = 3;
};

inline void fill(Vector<float>& values, std::size_t count, float size, Numbers& numbers) {
  values.resize(count);
  for (float& value : values) value = numbers.between(-size, size);
}

inline void fill_rows(ViewRows& rows, const TensorShape& shape, std::size_t count, Numbers& numbers) {
  for (std::size_t row = 0; row < count; ++row) {
    const std::uint32_t first = numbers.below(shape.clusters);
    for (std::uint32_t k = 0; k < shape.mixture; ++k)
      rows.membership.push_back(std::uint16_t((first + k) % shape.clusters));
  }
  fill(rows.coefficients, coefficient_count(shape, count), 1, numbers);
}

inline void fill_tensor(ClusteredTensor& tensor, const TensorShape& shape, std::uint32_t map_side,
                        Numbers& numbers) {
  tensor.shape = shape;
  // A value is a sum of K R_l R_v R_x R_y products of numbers up to one; this makes it about one.
  const float size = 10 / std::sqrt(float(core_size(shape) * shape.mixture));
  fill(tensor.cores, shape.clusters * core_size(shape), size, numbers);
  fill(tensor.x_bases, shape.clusters * x_basis_size(shape), 1, numbers);
  fill(tensor.y_bases, shape.clusters * y_basis_size(shape), 1, numbers);
  fill_rows(tensor.rows, shape, shape.views, numbers);
  tensor.map.side = map_side;
  fill_rows(tensor.map.rows, shape, std::size_t(map_side) * map_side, numbers);
}

// Two gentle waves, whose slopes no view of a tilt up to 63 degrees hides; or a plane.
inline Relief sample_relief(const SampleSize& size) {
  Relief relief;
  relief.high = size.relief_height;
  relief.low = size.relief_steps ? -size.relief_height : size.relief_height;
  relief.max_slope = 2;
  relief.steps = size.relief_steps;
  for (std::uint32_t i = 0; size.relief_steps && i < size.width * size.height; ++i) {
    const float x = float(i % size.width) / float(size.width), y = float(i / size.width) / float(size.height);
    relief.levels.push_back(
        std::uint8_t(127.5f + 63.7f * (std::cos(6.2831853f * x) + std::sin(6.2831853f * y))));
  }
  return relief;
}

// Blocks of any ends and codes, and weights with which heights lie within a tile and radiances at about 1.
inline Neural sample_neural(const SampleSize& size, Numbers& numbers) {
  Neural neural;
  neural.shape = {size.width, size.height, size.channels, size.units, size.layers, 4, size.units};
  neural.blocks.resize(neural_block_bytes_of(neural.shape));
  for (std::size_t i = 0; i < neural.blocks.size(); ++i) {
    std::uint8_t& byte = neural.blocks[i];
    const std::size_t at = i % neural_block_bytes;
    byte = std::uint8_t(at > 1    ? numbers.below(256)
                        : at == 0 ? numbers.below(128)
                                  : numbers.below(127) + 129);
  }
  const NeuralLayout at(neural.shape);
  for (std::size_t i = 0; i < at.count; ++i) {
    const float largest =
        i >= at.offset_out && i <= at.offset_level ? 0.04f : 0.7f * std::sqrt(8.0f / float(size.units));
    neural.weights.push_back(to_half(numbers.between(-largest, largest)));
  }
  for (std::size_t i = at.out_bias; i < at.count; ++i) neural.weights[i] = to_half(0.5f);
  return neural;
}

inline Material sample_material(std::uint32_t seed = 1, const SampleSize& size = {}) {
  Numbers numbers(seed);
  Material material;
  material.bits = size.bits;
  material.lights = hemisphere(size.lights);
  material.views = hemisphere(size.views);
  const TensorShape shape{size.views,  size.width,  size.height,   size.rank_light, size.rank_view,
                          size.rank_x, size.rank_y, size.clusters, size.mixture};
  if (size.channels > 0) {
    material.neural = sample_neural(size, numbers);
  } else {
    fill_tensor(material.btf, shape, size.map_side, numbers);
    fill(material.light_basis, 3 * size.lights * size.rank_light, 1, numbers);
  }
  material.visibility = size.visibility;
  if (size.visibility != VisibilityForm::none) {
    material.mapping = paper_mapping(size.visibility);
    TensorShape votf = shape;
    votf.rank_light = 1;
    fill_tensor(material.votf, votf, size.map_side, numbers);
  }
  if (size.relief_height != 0) material.relief = sample_relief(size);
  material.recipe = "{\"meso\": \"test\"}";
  return material;
}

// N-SVD, CTA, K-CTA, a resampled K-CTA, and integers of three forms.
inline const SampleSize sample_forms[] = {
    {.rank_view = 8, .clusters = 1, .mixture = 1},
    {.clusters = 4, .mixture = 1},
    {.rank_x = 6, .visibility = VisibilityForm::binary},
    {.map_side = 5},
    {.map_side = 4, .visibility = VisibilityForm::none},
    {.rank_view = 8, .clusters = 1, .mixture = 1, .bits = 8},
    {.rank_view = 5, .clusters = 4, .map_side = 5, .bits = 8},
    {.rank_x = 6, .visibility = VisibilityForm::none, .bits = 8},
};

}  // namespace nook::material::test
