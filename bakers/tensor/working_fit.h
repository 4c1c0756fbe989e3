// A clustered fit in progress. It works on the tensor whose global modes are reduced, and lists the members
// of each cluster.
#pragma once

#include "bakers/tensor/clustered_fit.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

// Global modes: modes with one basis for all clusters (section 5.2 of the paper).

// The reduced tensor A_G of equation (23).
struct Reduction {
  std::vector<Matrix> global_basis;  // per mode: I_n x R_n; empty if not global or of full rank
  Tensor held;                       // A_G if a mode was reduced, otherwise empty
  TensorView view;                   // A_G, or the input itself
  double lost = 0;                   // || A ||^2 - || A_G ||^2, which no cluster can explain
};
// Finds the global bases, which minimise || A - A x_n U_n U_n^T ||^2 over all n in G. Other modes are not
// reduced.
Reduction reduce_global_modes(const TensorView& a, const ClusteredSettings& settings,
                              const OnClustered& progress);

struct WorkingCluster {
  std::vector<std::size_t> members;  // ascending
  Matrix mixing;                     // members x R_m: the members' rows of U_{m,c}
  bool fitted = false;               // false if core and bases are not known yet
  ClusteredFit::Cluster parts;
};

struct WorkingFit {
  std::size_t mode = 0;
  std::size_t mixture = 1;                // K
  std::vector<std::uint32_t> membership;  // I_m x K
  std::vector<WorkingCluster> clusters;
};

// Sets the members of each cluster from `membership`. Keeps cores and bases.
void list_members(WorkingFit& fit);

// Fits core, bases and mixing rows of a cluster by an N-SVD of `shrunk`, the tensor of the cluster's members
// only. The N-SVD starts from the present bases and mixing rows (the rows may be missing). A cluster that was
// not fitted before starts from the HOSVD. Returns the squared error.
double fit_members(WorkingCluster& cluster, const Tensor& shrunk, const ClusteredSettings& settings);

// Returns Z_c x_n U_{n,c} for the members only.
Tensor expand_members(const WorkingCluster& cluster, std::size_t mode);

// Fits each initial cluster by an N-SVD of its members. Returns the squared norm of A_G - A^.
double fit_seeds(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                 const OnClustered& progress);

// Reports the progress of a clustered fit to its caller.

// Throws CANCELLED if the caller's function returns false.
inline void report(const OnClustered& progress, int iteration, const ClusteredSettings& settings,
                   std::size_t cluster, double objective) {
  if (progress && !progress({iteration, settings.iterations, cluster, objective}))
    throw Failure(NOOK_ERROR_CANCELLED,
                  "stopped by the progress callback in iteration %d of the clustered fit", iteration);
}

}  // namespace nook::bake::tensor
