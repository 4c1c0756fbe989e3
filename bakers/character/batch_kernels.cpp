#include "bakers/character/batch_kernels.h"

#include <algorithm>

#include "bakers/character/mini_batch_fit.h"
#include "sdk/src/core/compiler.h"

namespace nook::bake {

NOOK_CLONES void linear_layer_gradient(const LinearLayerFit& linear, std::span<const float> vertex_weight,
                                       const std::uint16_t* const* target, const float* shadow,
                                       std::size_t first, std::size_t last, float* gradient_shadow,
                                       float* gradient_alpha, float* gradient_bias) {
  constexpr std::size_t lanes = batch_poses;
  const std::size_t entries = linear.entries;
  for (std::size_t i = first; i < last; ++i) {
    float dark[lanes], slope[lanes];
    for (std::size_t l = 0; l < lanes; ++l) dark[l] = linear.bias[i];
    for (std::size_t s = i * entries; s < (i + 1) * entries; ++s) {
      const float a = linear.alpha[s];
      const float* row = shadow + std::size_t(linear.key_point[s]) * lanes;
#pragma omp simd
      for (std::size_t l = 0; l < lanes; ++l) dark[l] += a * row[l];
    }
    const float weight = vertex_weight[i] / float(lanes);
    for (std::size_t l = 0; l < lanes; ++l) slope[l] = 1 - float(target[l][i]) * AoTargets::scale;
    float bias = 0;
#pragma omp simd reduction(+ : bias)
    for (std::size_t l = 0; l < lanes; ++l) {
      slope[l] = weight * (std::clamp(dark[l], 0.0f, 1.0f) - slope[l]);
      bias += slope[l];
    }
    gradient_bias[i] = bias;
    for (std::size_t s = i * entries; s < (i + 1) * entries; ++s) {
      const float a = linear.alpha[s];
      const std::size_t offset = std::size_t(linear.key_point[s]) * lanes;
      const float* row = shadow + offset;
      float* out = gradient_shadow + offset;
      float sum = 0;
#pragma omp simd reduction(+ : sum)
      for (std::size_t l = 0; l < lanes; ++l) {
        sum += slope[l] * row[l];
        out[l] += a * slope[l];
      }
      gradient_alpha[s] = sum;
    }
  }
}

}  // namespace nook::bake
