// The inner loops of both layers of the fit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/character/fit_state.h"
#include "sdk/src/character/kernel.h"

namespace nook::bake {

// The inner loops of the non-linear layer: the shadow of one sphere on all key points, and its gradient. The
// arithmetic is the same as in sdk/src/character/kernel.h. The code is separate because it also computes
// derivatives.

// Arrays of `count` values, one array per coordinate; `count` is a multiple of 16.
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

// Adds y^gamma of one sphere to the sums. The centre is in world space, in metres.
void add_sphere(const Kernel& kernel, const float centre[3], float inverse_radius, const KeyPointArrays& keys,
                float* sum);

// Takes d(loss)/d(sum). Adds to the gradients of the key points, and returns the gradient of the sphere.
SphereGradient sphere_gradient(const Kernel& kernel, const float centre[3], float inverse_radius,
                               const KeyPointArrays& keys, const float* gradient_sum,
                               const KeyPointGradients& gradient);

// The inner loop of the linear layer over a batch of poses, with one SIMD lane per pose. It computes the
// error, and the gradients with respect to the layer's weights and the shadows.

// Processes vertices [first, last) of a batch of batch_poses poses. `shadow` is key points x lanes, and
// target[lane] is the row of targets of one pose. Adds to gradient_shadow (key points x lanes), and
// overwrites gradient_alpha and gradient_bias of these vertices. The loss is half the weighted squared error
// of the clamped AO, averaged over lanes. It is 0 where clamping makes the prediction equal to the target.
void linear_layer_gradient(const LinearLayerFit& linear, std::span<const float> vertex_weight,
                           const std::uint16_t* const* target, const float* shadow, std::size_t first,
                           std::size_t last, float* gradient_shadow, float* gradient_alpha,
                           float* gradient_bias);

}  // namespace nook::bake
