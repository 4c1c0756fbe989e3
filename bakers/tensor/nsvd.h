// N-SVD (De Lathauwer et al. 2000): A ~ Z x_1 U_1 ... x_N U_N of equation (5), by alternating least squares
// that starts from the truncated higher-order SVD.
#pragma once

#include <functional>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

struct NsvdSettings {
  std::vector<std::size_t> ranks;  // R_n for each mode, 1 to I_n
  int iterations = 10;             // sweeps over all modes at most, after the start; 0: the truncated HOSVD
  double tolerance = 1e-4;         // ends when a sweep lowers the squared error by less than this share of it
};

// An empty basis is the identity: of a mode that keeps its full rank.
struct Nsvd {
  Tensor core;                    // R_1 x ... x R_N
  std::vector<Matrix> basis;      // a mode: I_n x R_n, columns orthonormal, the most important first
  std::vector<double> objective;  // || A - A^ ||^2 after the start and after each sweep; never rises
};

struct NsvdProgress {
  int sweep = 0, sweeps = 0;  // sweep 0: the HOSVD
  std::size_t mode = 0;       // whose basis comes next
  double objective = 0;       // after the last sweep, 0 before
};
// Returns false to stop; called from the calling thread.
using OnNsvd = std::function<bool(const NsvdProgress&)>;

// Memory: the input, and about 1 / I_1 of it for each thread, and the input reduced by all modes but one. The
// same bits on any number of threads (those of the caller's TBB arena). Throws INVALID_ARGUMENT for what
// check_tensor refuses and for ranks that do not fit, CANCELLED where progress returned false.
Nsvd fit_nsvd(const TensorView& a, const NsvdSettings& settings, const OnNsvd& progress = {});

Tensor reconstruct(const Nsvd& fit);

// The alternating least squares of N-SVD from given bases.

// Returns U_n of the truncated higher-order SVD for each mode. It is empty if R_n = I_n or if the mode is
// kept whole.
std::vector<Matrix> hosvd_bases(const TensorView& a, const std::vector<std::size_t>& ranks,
                                const OnNsvd& progress = {});

struct Alternation {
  std::vector<std::size_t> ranks;  // R_n = I_n keeps a mode whole, with an empty basis
  std::size_t first = 0;           // the mode that starts each sweep; its basis may be missing
  int sweeps = 10;
  double tolerance = 1e-4;
};

// Lowers || A - Z x_n U_n ||^2 in at least one sweep. The result is no worse than the given bases. squared is
// || A ||^2.
Nsvd alternate(const TensorView& a, double squared, std::vector<Matrix> bases, const Alternation& settings,
               const OnNsvd& progress = {});

}  // namespace nook::bake::tensor
