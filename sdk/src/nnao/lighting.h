// Lighting with AO and bent normals on the CPU, for tests and measurements. These are the same functions as
// in shaders/nnao/host.glsl.
#pragma once

#include <array>

#include "sdk/src/core/vec.h"

namespace nook::nnao {

// The weights of a small network with one hidden layer, which computes specular occlusion. Its inputs are x =
// (cos, dot(b, r), dot(n, v), dot(n, b), roughness). cos = sqrt(1 - AO) is the cosine of the cone's half
// angle, b the bent normal, n the normal, v the direction to the viewer, and r its reflection. The output is
//   hidden = out . max(weights x + bias, 0) + out_bias
//   occlusion = clamp(lerp(1 - cos hidden, AO, roughness^4), 0, 1).
// Roughness is perceptual: the GGX width is its square. At roughness 1, the occlusion equals the AO of the
// whole hemisphere.
struct SpecularNumbers {
  static constexpr int inputs = 5, units = 8;

  std::array<std::array<float, units>, inputs> weights{};
  std::array<float, units> bias{}, out{};
  float out_bias = 0;
};
// Returns the weights that the shader uses. `nook train specular` computed them.
SpecularNumbers specular_numbers();

// The inputs of the specular occlusion at a pixel. Directions have unit length.
struct LitPixel {
  Vec3 bent_normal, normal, to_viewer;
  float ao = 1;
};

std::array<float, SpecularNumbers::inputs> specular_inputs(const LitPixel& pixel, float roughness);
float specular_occlusion(const SpecularNumbers& numbers, const LitPixel& pixel, float roughness);

// The visibility cone is the cone around the bent normal that has the same AO as the pixel. Returns the
// cosine of its half angle.
float cone_cosine(float ao);

// Returns AO brightened by the light that the surroundings reflect, for one channel of the albedo.
float multi_bounce(float ao, float albedo);

}  // namespace nook::nnao
