// The ranks that an error needs.
#pragma once

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Returns, for each mode alone with the others complete, the smallest rank that is a multiple of `multiple`
// (or I_n) at which || A - A^ ||^2 <= share[n] || A ||^2. This is the choice of ranks of section 6 of the
// paper. Shares below 1e-6 are below the rounding of floats.
std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple = 4);

}  // namespace nook::bake::tensor
