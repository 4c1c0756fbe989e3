// N-SVD (De Lathauwer et al. 2000): A ~ Z x_1 U_1 ... x_N U_N of equation (5). It is fitted by alternating
// least squares, which start from the truncated higher-order SVD (HOSVD).
#pragma once

#include <functional>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

struct NsvdSettings {
  std::vector<std::size_t> ranks;  // R_n for each mode, 1 to I_n
  int iterations = 10;             // maximum number of sweeps over all modes; 0: only the truncated HOSVD
  double tolerance = 1e-4;  // the fit ends when a sweep lowers the squared error by less than this share
};

// A mode that keeps its full rank has an empty basis, which means the identity.
struct Nsvd {
  Tensor core;                    // R_1 x ... x R_N
  std::vector<Matrix> basis;      // per mode: I_n x R_n, orthonormal columns, most important first
  std::vector<double> objective;  // squared norm of A - A^ after the start and each sweep; never rises
};

struct NsvdProgress {
  int sweep = 0, sweeps = 0;  // sweep 0: the HOSVD
  std::size_t mode = 0;       // the mode whose basis is computed next
  double objective = 0;       // after the last sweep; 0 before the first result
};
// Return false to stop. The function is called on the thread that started the fit.
using OnNsvd = std::function<bool(const NsvdProgress&)>;

// Needs memory for the input, for about 1 / I_1 of the input per thread, and for the input with all modes
// except one reduced. Runs in the caller's TBB arena, and returns the same bits on any number of threads.
// Throws INVALID_ARGUMENT if check_tensor fails or the ranks do not fit the tensor, and CANCELLED if
// `progress` returns false.
Nsvd fit_nsvd(const TensorView& a, const NsvdSettings& settings, const OnNsvd& progress = {});

Tensor reconstruct(const Nsvd& fit);

// For each mode, returns U_n of the truncated higher-order SVD. U_n is empty if R_n = I_n, because the mode
// is then not reduced.
std::vector<Matrix> hosvd_bases(const TensorView& a, const std::vector<std::size_t>& ranks,
                                const OnNsvd& progress = {});

struct Alternation {
  std::vector<std::size_t> ranks;  // R_n = I_n: the mode is not reduced, and its basis is empty
  std::size_t first = 0;           // the mode that starts each sweep; its basis may be missing
  int sweeps = 10;
  double tolerance = 1e-4;
};

// Lowers the squared norm of A - Z x_n U_n by alternating least squares, starting from the given bases. Runs
// at least one sweep if a basis is missing. The result is never worse than the given bases. `squared` is the
// squared norm of A.
Nsvd alternate(const TensorView& a, double squared, std::vector<Matrix> bases, const Alternation& settings,
               const OnNsvd& progress = {});

}  // namespace nook::bake::tensor
