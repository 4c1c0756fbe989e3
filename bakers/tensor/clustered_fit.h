// Settings and results of the clustered tensor approximations: CTA (Tsai and Shih 2006) and K-CTA (Tsai and
// Shih 2012), equation (8):
//   A ~ sum_c Z_c x_1 U_{1,c} ... x_N U_{N,c}.
// Every mode-m sub-tensor belongs to K clusters. In the mixing matrices U_{m,c} of all other clusters, its
// row is zero.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/tensor/nsvd.h"

namespace nook::bake::tensor {

// How the clustering stage finds the K clusters of a sub-tensor.
enum class Pursuit : std::uint8_t {
  greedy,      // chooses one cluster after another, by (9) and (13), as in Algorithm 1
  exchange,    // greedy; then exchanges single clusters as long as this lowers the error
  exhaustive,  // tries every set of K clusters: exact, and practical up to a few thousand sets
};

struct ClusteredSettings {
  std::size_t mode = 0;            // the clustered mode m
  std::vector<std::size_t> ranks;  // R_n for each mode; R_m is the rank of each cluster
  std::size_t clusters = 1;        // C, 1 to I_m
  std::size_t mixture = 1;         // K, 1 to C; 1 for CTA
  std::vector<std::size_t>
      global_modes;  // G: modes with one basis for all clusters, equation (23); must not contain m
  // The initial cluster of each mode-m sub-tensor, see tensor/seed_clusters.h. No cluster may be empty.
  std::vector<std::uint32_t> seeds;

  int iterations = 40;  // maximum number for Algorithm 1; 0: only the initial fit, one cluster per sub-tensor
  // The fit ends when an iteration lowers the squared error by less than this share of the error. Algorithm 1
  // tests the sum of the cores' norms instead. For K > 1, this sum can stay constant by chance while the
  // error still falls.
  double tolerance = 3e-4;
  int sweeps = 1;  // N-SVD sweeps per cluster in an update stage; more sweeps improve little
  Pursuit pursuit = Pursuit::greedy;
  // Only for CTA: each sub-tensor tries its own cluster and this number of clusters with the nearest means.
  // 0: it tries all clusters.
  std::size_t nearest = 0;
  // If true, a sub-tensor keeps its previous clusters if the search finds worse ones. If false, the fit
  // follows Algorithm 1 exactly, but it must undo iterations more often.
  bool keep_better_clusters = true;
};

// The clusters that each mode-m sub-tensor mixes, in the order in which they were found, and the rows of the
// mixing matrices U_{m,c} for these clusters. All other rows of U_{m,c} are zero.
struct Mixture {
  std::size_t count = 0;                  // K
  std::vector<std::uint32_t> membership;  // I_m x K; a row has no cluster twice
  Matrix coefficients;                    // I_m x (K R_m)
};

// A mode with full rank has an empty basis, which means the identity. If a cluster has fewer than R_m
// members, the last mode-m slices of its core and the corresponding columns of U_{m,c} are zero.
struct ClusteredFit {
  std::size_t mode = 0;
  Dimensions dimensions, ranks;
  std::vector<Matrix> global_basis;  // for each mode: I_n x R_n, empty if n is not in G

  struct Cluster {
    Tensor core;                // R_1 x ... x R_N
    std::vector<Matrix> basis;  // for each mode: I_n x R_n; empty for global modes and for mode m
  };
  std::vector<Cluster> clusters;
  Mixture mixture;

  std::vector<double>
      objective;           // squared norm of A - A^ after the start and after each iteration; never rises
  bool undone = false;     // true if the last iteration raised the error and was undone
  std::size_t splits = 0;  // number of empty clusters that were filled by splitting another cluster
};

struct ClusteredProgress {
  int iteration = 0, iterations = 0;  // iteration 0: the start
  std::size_t cluster = 0;            // the present cluster of the update stage
  double objective = 0;               // after the last finished iteration; 0 before
};
// Return false to stop. The function is called on the thread that started the fit.
using OnClustered = std::function<bool(const ClusteredProgress&)>;

// Both functions run in the caller's TBB arena, and return the same bits for the same seeds on any number of
// threads. They throw INVALID_ARGUMENT if check_tensor fails or the settings do not fit the tensor, and
// CANCELLED if `progress` returns false. They need memory for the input and for three tensors of the size
// that remains after the global modes are reduced. Other memory is small.
ClusteredFit fit_cta(const TensorView& a, const ClusteredSettings& settings,
                     const OnClustered& progress = {});
ClusteredFit fit_k_cta(const TensorView& a, const ClusteredSettings& settings,
                       const OnClustered& progress = {});

// Converts an N-SVD to a fit with one cluster that contains every sub-tensor: C = K = 1.
ClusteredFit as_one_cluster(const Nsvd& fit, std::size_t mode);

Tensor reconstruct(const ClusteredFit& fit);

// These functions check settings. The message names the wrong setting.

// They throw INVALID_ARGUMENT. Like the paper, messages count modes from 1.
void check_ranks(const Dimensions& dimensions, const std::vector<std::size_t>& ranks);
void check_iterations(int iterations, double tolerance);
void check_clustered(const Dimensions& dimensions, const ClusteredSettings& settings);

}  // namespace nook::bake::tensor
