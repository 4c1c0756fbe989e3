// Interpolates smoothly between the sampled views.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/tensor/tensor.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Returns the weights of a thin-plate spline over the parabolic map (the paper's 6.3.2). Row (row * side +
// column) has the weight of each view for the direction of that cell of sdk's ViewMap. In the direction of a
// view, its own weight is 1. The weights of a row sum to 1. Beyond the outermost view, a spline would only
// guess, so cells take the value at the rim.
tensor::Matrix spline_weights(const std::vector<Vec3>& views, std::uint32_t side);

// Returns the weights for arbitrary directions, one row per direction.
tensor::Matrix spline_weights(const std::vector<Vec3>& views, const std::vector<Vec3>& directions);

}  // namespace nook::bake::material
