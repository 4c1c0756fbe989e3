// The ranks that an error needs.
#pragma once

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// For each mode alone, the others left whole, the least rank that is a multiple of `multiple` (or I_n) at
// which || A - A^ ||^2 <= share[n] || A ||^2 (shares below 1e-6 drown in the rounding of floats): the paper's
// choice of ranks (section 6).
std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple = 4);

}  // namespace nook::bake::tensor
