// The two stages of Algorithm 1: clustering and update.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bakers/tensor/working_fit.h"

namespace nook::bake::tensor {

// Clusters that no sub-tensor chose (section 5.3 of the paper).

// Fills each empty cluster by splitting the cluster with the largest sum of errors. The half of its members
// with the larger errors moves to the empty cluster, which changes their entries in `membership` (I_m x K).
// Returns the indices of the changed entries. Never splits a cluster with one member. If no cluster has two
// members, the empty clusters stay empty.
std::vector<std::size_t> split_into_empty(std::vector<std::uint32_t>& membership, std::size_t mixture,
                                          std::size_t clusters, const std::vector<double>& error);

// Searches the clusters of each sub-tensor, sets membership, mixing rows and cores (4.2.3), and fills empty
// clusters. Sets `residual` to A_G - A^. Returns the number of filled clusters.
std::size_t clustering_stage(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                             Tensor& residual);

// Fits the clusters one after another, (20) to (22). Each cluster is fitted to the part of its members that
// the other clusters do not explain. Pass A_G - A^ as `residual`; it is updated to the new A_G - A^.
void update_stage(WorkingFit& fit, Tensor& residual, const ClusteredSettings& settings,
                  const OnClustered& progress, int iteration, double objective);

}  // namespace nook::bake::tensor
