// The initial clusters (the paper's 5.1): k-means of points, one for each sub-tensor of the clustered mode.
#pragma once

#include <cstdint>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Groups rows by k-means without empty groups. It takes the best of a few starts, drawn like Arthur &
// Vassilvitskii 2007 (k-means++), with Lloyd's iterations. Returns the group of each row. If the rows are the
// directions of the clustered mode as unit vectors, this is the clustering in the parametric space that the
// paper prefers. The same seed gives the same groups. Throws INVALID_ARGUMENT for 0 clusters, more clusters
// than distinct rows, or an entry that is not finite.
std::vector<std::uint32_t> seed_clusters(const Matrix& points, std::size_t clusters, std::uint64_t seed = 1);

// Returns points with the same distances as the mode-m sub-tensors. On them, seed_clusters is k-means of the
// sub-tensors.
Matrix sub_tensor_points(const TensorView& a, std::size_t mode);

}  // namespace nook::bake::tensor
