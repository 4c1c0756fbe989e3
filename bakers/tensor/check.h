// Checks of settings, with messages that name them.
#pragma once

#include "bakers/tensor/clustered_fit.h"

namespace nook::bake::tensor {

// All of them throw INVALID_ARGUMENT. Messages count modes from 1, as the paper does.
void check_ranks(const Dimensions& dimensions, const std::vector<std::size_t>& ranks);
void check_iterations(int iterations, double tolerance);
void check_clustered(const Dimensions& dimensions, const ClusteredSettings& settings);

}  // namespace nook::bake::tensor
