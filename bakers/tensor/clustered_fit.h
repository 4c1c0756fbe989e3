// Settings and results of the clustered tensor approximations: CTA (Tsai and Shih 2006) and K-CTA (Tsai and
// Shih 2012), equation (8):
//   A ~ sum_c Z_c x_1 U_{1,c} ... x_N U_{N,c},
// where every mode-m sub-tensor belongs to K clusters; the rows of the mixing matrices U_{m,c} are zero for
// all other clusters.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/tensor/nsvd.h"

namespace nook::bake::tensor {

// The search of the clustering stage for the K clusters of a sub-tensor.
enum class Pursuit : std::uint8_t {
  greedy,      // one after another, (9) and (13), as in Algorithm 1
  exchange,    // greedy, then exchanges single clusters while that lowers the error
  exhaustive,  // every set of K clusters: exact, and affordable while C choose K is a few thousand
};

struct ClusteredSettings {
  std::size_t mode = 0;                   // the clustered mode m
  std::vector<std::size_t> ranks;         // R_n for each mode; for mode m, the rank of a cluster
  std::size_t clusters = 1;               // C, 1 to I_m
  std::size_t mixture = 1;                // K, 1 to C; 1 for CTA
  std::vector<std::size_t> global_modes;  // G: modes with one basis for all clusters, equation (23); never m
  // The first cluster of each mode-m sub-tensor, see tensor/seed_clusters.h. No cluster may be empty.
  std::vector<std::uint32_t> seeds;

  int iterations = 40;  // maximum number in Algorithm 1; 0: only the start, with one cluster for each
                        // sub-tensor
  // The fit ends when an iteration lowers the squared error by less than this share of it. Algorithm 1 tests
  // the sum of the cores' norms, which for K > 1 can be stationary by chance while the error still falls.
  double tolerance = 3e-4;
  int sweeps = 1;  // sweeps in the N-SVD of one cluster in an update stage; more change little
  Pursuit pursuit = Pursuit::greedy;
  // For CTA: each sub-tensor tries its own cluster and this number of clusters with the nearest means; 0:
  // all.
  std::size_t nearest = 0;
  // A sub-tensor keeps its previous clusters if the search found worse ones. false: exactly Algorithm 1,
  // which must then undo iterations more often.
  bool keep_better_clusters = true;
};

// The clusters that each sub-tensor of mode m mixes, in the order in which they were found, and the rows of
// their mixing matrices. These rows are all non-zero entries of U_{m,c}.
struct Mixture {
  std::size_t count = 0;                  // K
  std::vector<std::uint32_t> membership;  // I_m x K, all different in a row
  Matrix coefficients;                    // I_m x (K R_m)
};

// An empty basis is the identity, for a mode with full rank. If a cluster has fewer than R_m members, the
// last mode-m slices of its core and the corresponding columns of U_{m,c} are zero.
struct ClusteredFit {
  std::size_t mode = 0;
  Dimensions dimensions, ranks;
  std::vector<Matrix> global_basis;  // for each mode: I_n x R_n, empty if n is not in G

  struct Cluster {
    Tensor core;                // R_1 x ... x R_N
    std::vector<Matrix> basis;  // for each mode: I_n x R_n; empty for global modes and for m
  };
  std::vector<Cluster> clusters;
  Mixture mixture;

  std::vector<double> objective;  // squared norm of A - A^ after the start and each iteration; never rises
  bool undone = false;            // the last iteration raised the error, so the result is the one before
  std::size_t splits = 0;         // empty clusters that were filled by splitting another one
};

struct ClusteredProgress {
  int iteration = 0, iterations = 0;  // iteration 0: the start
  std::size_t cluster = 0;            // in the update stage
  double objective = 0;               // after the last iteration; 0 before
};
// Return false to stop. The calling thread runs it.
using OnClustered = std::function<bool(const ClusteredProgress&)>;

// Both functions give the same bits for the same seeds on any number of threads of the caller's TBB arena.
// They throw INVALID_ARGUMENT if check_tensor fails or settings do not fit, and CANCELLED if progress
// returned false. They need memory for the input, three tensors of the input's size after its global modes
// are reduced, and smaller parts.
ClusteredFit fit_cta(const TensorView& a, const ClusteredSettings& settings,
                     const OnClustered& progress = {});
ClusteredFit fit_k_cta(const TensorView& a, const ClusteredSettings& settings,
                       const OnClustered& progress = {});

// Returns an N-SVD as one cluster with every sub-tensor as a member: C = K = 1.
ClusteredFit as_one_cluster(const Nsvd& fit, std::size_t mode);

Tensor reconstruct(const ClusteredFit& fit);

// Checks settings, with messages that name them.

// All throw INVALID_ARGUMENT. Messages count modes from 1, like the paper.
void check_ranks(const Dimensions& dimensions, const std::vector<std::size_t>& ranks);
void check_iterations(int iterations, double tolerance);
void check_clustered(const Dimensions& dimensions, const ClusteredSettings& settings);

}  // namespace nook::bake::tensor
