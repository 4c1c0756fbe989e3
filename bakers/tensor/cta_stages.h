// The two stages of Algorithm 1: clustering and update.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/tensor/working_fit.h"

namespace nook::bake::tensor {

// Fills clusters that no sub-tensor chose (the paper's 5.3).

// Fills each empty cluster from the cluster with the greatest sum of errors. The half of its members with the
// greater errors moves to the empty cluster, in their row of the membership (I_m x K). Returns the entries of
// the membership that changed. A cluster with one member is never split. If there is no other, clusters stay
// empty.
std::vector<std::size_t> split_into_empty(std::vector<std::uint32_t>& membership, std::size_t mixture,
                                          std::size_t clusters, const std::vector<double>& error);

// Searches the clusters of each sub-tensor, sets membership, mixing rows and cores (4.2.3), and fills empty
// clusters. Returns the number of filled clusters. residual becomes A_G - A^.
std::size_t clustering_stage(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                             Tensor& residual);

// Fits one cluster after the other to what the others leave of its members, (20) to (22). residual is A_G -
// A^ before and after.
void update_stage(WorkingFit& fit, Tensor& residual, const ClusteredSettings& settings,
                  const OnClustered& progress, int iteration, double objective);

}  // namespace nook::bake::tensor
