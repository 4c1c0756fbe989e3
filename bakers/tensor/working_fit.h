// A clustered fit in the making: clusters by their members, on the tensor whose global modes are reduced.
#pragma once

#include "bakers/tensor/global_modes.h"

namespace nook::bake::tensor {

struct WorkingCluster {
  std::vector<std::size_t> members;  // rising
  Matrix mixing;                     // members x R_m: the rows of U_{m,c} that are not zero
  bool fitted = false;               // false: core and bases are still to be found
  ClusteredFit::Cluster parts;
};

struct WorkingFit {
  std::size_t mode = 0;
  std::size_t mixture = 1;                // K of the membership
  std::vector<std::uint32_t> membership;  // I_m x K
  std::vector<WorkingCluster> clusters;
};

// Lists the members of each cluster from the membership; parts stay.
void list_members(WorkingFit& fit);

// Fits core, bases and mixing rows of a cluster by an N-SVD of the shrunk tensor, which has its members only.
// It starts from the present ones (mixing rows may be missing), or from the HOSVD. Returns the squared error.
double fit_members(WorkingCluster& cluster, const Tensor& shrunk, const ClusteredSettings& settings);

// Z_c x_n U_{n,c}, members only.
Tensor expand_members(const WorkingCluster& cluster, std::size_t mode);

// Each seed's cluster by an N-SVD of its members. Returns || A_G - A^ ||^2.
double fit_seeds(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                 const OnClustered& progress);

}  // namespace nook::bake::tensor
