// The clusters to begin with (the paper's 5.1): k-means of points, one for each sub-tensor of the clustered
// mode.
#pragma once

#include <cstdint>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Groups rows by k-means, no group empty: the best of a few starts, each drawn as Arthur & Vassilvitskii 2007
// (k-means++), with Lloyd's iterations. Returns the group of each row. With the directions of the clustered
// mode as rows, unit vectors, this is the clustering in the parametric space that the paper prefers. The same
// groups for the same seed. Throws INVALID_ARGUMENT for 0 clusters, more clusters than distinct rows, or an
// entry that is not finite.
std::vector<std::uint32_t> seed_clusters(const Matrix& points, std::size_t clusters, std::uint64_t seed = 1);

// Points whose distances are those of the mode-m sub-tensors: with them, seed_clusters is k-means of the
// sub-tensors.
Matrix sub_tensor_points(const TensorView& a, std::size_t mode);

}  // namespace nook::bake::tensor
