#include "sdk/src/nnao/lighting.h"

#include <algorithm>
#include <cmath>

#include "shaders/nnao/specular_numbers.h"

namespace nook::nnao {

SpecularNumbers specular_numbers() {
  // Seven rows of eight units: the weights of each of the five inputs, the biases, and the output weights.
  constexpr float rows[7][8] = {
      {NOOK_SPECULAR_0, NOOK_SPECULAR_1},   {NOOK_SPECULAR_2, NOOK_SPECULAR_3},
      {NOOK_SPECULAR_4, NOOK_SPECULAR_5},   {NOOK_SPECULAR_6, NOOK_SPECULAR_7},
      {NOOK_SPECULAR_8, NOOK_SPECULAR_9},   {NOOK_SPECULAR_10, NOOK_SPECULAR_11},
      {NOOK_SPECULAR_12, NOOK_SPECULAR_13},
  };
  SpecularNumbers numbers;
  for (std::size_t u = 0; u < SpecularNumbers::units; ++u) {
    for (std::size_t i = 0; i < SpecularNumbers::inputs; ++i) numbers.weights[i][u] = rows[i][u];
    numbers.bias[u] = rows[5][u];
    numbers.out[u] = rows[6][u];
  }
  numbers.out_bias = NOOK_SPECULAR_BIAS;
  return numbers;
}

float cone_cosine(float ao) {
  return std::sqrt(std::clamp(1 - ao, 0.0f, 1.0f));
}

std::array<float, SpecularNumbers::inputs> specular_inputs(const LitPixel& pixel, float roughness) {
  const float facing = std::clamp(dot(pixel.normal, pixel.to_viewer), 0.0f, 1.0f);
  const Vec3 reflection = 2 * facing * pixel.normal - pixel.to_viewer;
  return {cone_cosine(pixel.ao), dot(pixel.bent_normal, reflection), facing,
          dot(pixel.normal, pixel.bent_normal), roughness};
}

float specular_occlusion(const SpecularNumbers& numbers, const LitPixel& pixel, float roughness) {
  const auto x = specular_inputs(pixel, roughness);
  float hidden = numbers.out_bias;
  for (std::size_t u = 0; u < SpecularNumbers::units; ++u) {
    float sum = numbers.bias[u];
    for (std::size_t i = 0; i < x.size(); ++i) sum += numbers.weights[i][u] * x[i];
    hidden += numbers.out[u] * std::max(sum, 0.0f);
  }
  const float rough = roughness * roughness * roughness * roughness;
  return std::clamp((1 - x[0] * hidden) * (1 - rough) + pixel.ao * rough, 0.0f, 1.0f);
}

float multi_bounce(float ao, float albedo) {
  // The polynomial of Jimenez et al. 2016.
  const float a = 2.0404f * albedo - 0.3324f, b = 0.6417f - 4.7951f * albedo, c = 2.7552f * albedo + 0.6903f;
  return std::max(ao, ((ao * a + b) * ao + c) * ao);
}

}  // namespace nook::nnao
