// The alternating least squares of N-SVD from given bases.
#pragma once

#include "bakers/tensor/nsvd.h"

namespace nook::bake::tensor {

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
