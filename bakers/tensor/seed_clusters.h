// The initial clusters (section 5.1 of the paper): k-means on points, one point per sub-tensor of the
// clustered mode.
#pragma once

#include <cstdint>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Groups rows by k-means, without empty groups. Returns the group of each row. Runs Lloyd's iterations from a
// few starts that are drawn by k-means++ (Arthur & Vassilvitskii 2007), and takes the best result. The paper
// prefers to cluster in parametric space: for this, pass the direction of each sub-tensor as a unit vector.
// The same seed gives the same groups. Throws INVALID_ARGUMENT if `clusters` is 0 or exceeds the number of
// distinct rows, or if an entry is not finite.
std::vector<std::uint32_t> seed_clusters(const Matrix& points, std::size_t clusters, std::uint64_t seed = 1);

// Returns one point per mode-m sub-tensor. The points have the same distances from each other as the
// sub-tensors. Pass them to seed_clusters to cluster the sub-tensors themselves.
Matrix sub_tensor_points(const TensorView& a, std::size_t mode);

}  // namespace nook::bake::tensor
