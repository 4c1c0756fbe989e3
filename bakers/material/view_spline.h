// Interpolation between the sampled views, smooth where the views are.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/tensor/tensor.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Returns the weights of a thin-plate spline over the parabolic map (the paper's 6.3.2). Row row * side +
// column holds the weight of each view in the direction of that cell of sdk's ViewMap. At a view itself its
// weight is 1, and weights sum to 1. Beyond the outermost view, where a spline would only guess, cells take
// the value at the rim.
tensor::Matrix spline_weights(const std::vector<Vec3>& views, std::uint32_t side);

// The same for any directions.
tensor::Matrix spline_weights(const std::vector<Vec3>& views, const std::vector<Vec3>& directions);

}  // namespace nook::bake::material
