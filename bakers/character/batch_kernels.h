// The linear layer's inner loop over a batch of poses, one SIMD lane each: error, and gradients of both its
// sides.
#pragma once

#include <cstdint>
#include <span>

#include "bakers/character/fit_state.h"

namespace nook::bake {

// For vertices [first, last) of a batch of batch_poses poses: shadow is key points x lanes, target[lane] a
// pose's row. Adds to gradient_shadow (key points x lanes), writes gradient_alpha and gradient_bias of these
// vertices. The loss is the weighted squared error of the clamped AO, halved, mean over lanes; where the
// clamp holds a right answer there is none.
void linear_layer_gradient(const LinearLayerFit& linear, std::span<const float> vertex_weight,
                           const std::uint16_t* const* target, const float* shadow, std::size_t first,
                           std::size_t last, float* gradient_shadow, float* gradient_alpha,
                           float* gradient_bias);

}  // namespace nook::bake
