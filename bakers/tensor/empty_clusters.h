// Clusters that no sub-tensor chose (the paper's 5.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nook::bake::tensor {

// Fills each empty cluster with half of the members of the cluster with the greatest sum of errors: those
// with the greater errors, which change from it to the empty one in their row of the membership (I_m x K).
// Returns the entries of the membership that changed; a cluster of one member is never split, and where there
// is no other, clusters stay empty.
std::vector<std::size_t> split_into_empty(std::vector<std::uint32_t>& membership, std::size_t mixture,
                                          std::size_t clusters, const std::vector<double>& error);

}  // namespace nook::bake::tensor
