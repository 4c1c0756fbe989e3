// The inner loops of the non-linear layer: one sphere against all key points, and the gradient. The
// arithmetic is that of sdk/src/character/kernel.h, kept apart because it carries derivatives.
#pragma once

#include <cstddef>

#include "sdk/src/character/kernel.h"

namespace nook::bake {

// Arrays of count values (a multiple of 16), one for each coordinate.
struct KeyPointArrays {
  const float *px, *py, *pz, *nx, *ny, *nz;
  std::size_t count;
};
struct KeyPointGradients {
  float *px, *py, *pz, *nx, *ny, *nz;
};
struct SphereGradient {
  float x = 0, y = 0, z = 0, log_radius = 0;
};

// Adds y^gamma of one sphere (world centre, metres; inverse radius) to sum.
void add_sphere(const Kernel& kernel, const float centre[3], float inverse_radius, const KeyPointArrays& keys,
                float* sum);

// Given d(loss)/d(sum), adds to the key points' gradients and returns the sphere's.
SphereGradient sphere_gradient(const Kernel& kernel, const float centre[3], float inverse_radius,
                               const KeyPointArrays& keys, const float* gradient_sum,
                               const KeyPointGradients& gradient);

}  // namespace nook::bake
