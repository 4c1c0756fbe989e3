// Settings that do not fit, named.
#pragma once

#include "bakers/tensor/clustered_fit.h"

namespace nook::bake::tensor {

// All throw INVALID_ARGUMENT. Modes are counted from 1 in messages, as in the paper.
void check_ranks(const Dimensions& dimensions, const std::vector<std::size_t>& ranks);
void check_iterations(int iterations, double tolerance);
void check_clustered(const Dimensions& dimensions, const ClusteredSettings& settings);

}  // namespace nook::bake::tensor
