// The inner loops of both layers of the fit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/character/fit_state.h"
#include "sdk/src/character/kernel.h"

namespace nook::bake {

// The inner loops of the non-linear layer: one sphere against all key points, and the gradient. The
// arithmetic is the same as in sdk/src/character/kernel.h. It is separate because it carries derivatives.

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

// Adds y^gamma of one sphere (world centre and inverse radius, metres) to sum.
void add_sphere(const Kernel& kernel, const float centre[3], float inverse_radius, const KeyPointArrays& keys,
                float* sum);

// Takes d(loss)/d(sum), adds to the gradients of the key points and returns the gradient of the sphere.
SphereGradient sphere_gradient(const Kernel& kernel, const float centre[3], float inverse_radius,
                               const KeyPointArrays& keys, const float* gradient_sum,
                               const KeyPointGradients& gradient);

// The linear layer's inner loop over a batch of poses, with one SIMD lane for each pose. It computes the
// error, and the gradients of the layer's weights and of its shadows.

// Processes vertices [first, last) of a batch of batch_poses poses. shadow is key points x lanes, and
// target[lane] is the row of a pose. Adds to gradient_shadow (key points x lanes), and writes gradient_alpha
// and gradient_bias of these vertices. The loss is half the weighted squared error of the clamped AO, as a
// mean over lanes. It is 0 where clamping makes the answer right.
void linear_layer_gradient(const LinearLayerFit& linear, std::span<const float> vertex_weight,
                           const std::uint16_t* const* target, const float* shadow, std::size_t first,
                           std::size_t last, float* gradient_shadow, float* gradient_alpha,
                           float* gradient_bias);

}  // namespace nook::bake
