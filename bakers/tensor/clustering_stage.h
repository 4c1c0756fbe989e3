// The clustering stage of Algorithm 1.
#pragma once

#include "bakers/tensor/working_fit.h"

namespace nook::bake::tensor {

// Searches the clusters of each sub-tensor, sets membership, mixing rows and cores (4.2.3), and fills empty
// clusters. Returns the number of those. residual becomes A_G - A^.
std::size_t clustering_stage(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                             Tensor& residual);

}  // namespace nook::bake::tensor
