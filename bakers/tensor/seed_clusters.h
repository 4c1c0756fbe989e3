// The initial clusters (section 5.1 of the paper): k-means on points, one point per sub-tensor of the
// clustered mode.
#pragma once

#include <cstdint>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Groups rows by k-means, without empty groups. Returns the group of each row. Uses the best of a few starts,
// drawn by k-means++ (Arthur & Vassilvitskii 2007), with Lloyd's iterations. If each row is the direction of
// a sub-tensor as a unit vector, the rows are clustered in parametric space, which the paper prefers. The
// same seed gives the same groups. Throws INVALID_ARGUMENT if `clusters` is 0 or exceeds the number of
// distinct rows, or if an entry is not finite.
std::vector<std::uint32_t> seed_clusters(const Matrix& points, std::size_t clusters, std::uint64_t seed = 1);

// Returns one point per mode-m sub-tensor. The points have the same distances as the sub-tensors. Pass them
// to seed_clusters to cluster the sub-tensors themselves.
Matrix sub_tensor_points(const TensorView& a, std::size_t mode);

}  // namespace nook::bake::tensor
