// The alternating least squares of N-SVD, from bases that are given.
#pragma once

#include "bakers/tensor/nsvd.h"

namespace nook::bake::tensor {

// U_n of the truncated higher-order SVD for each mode, empty where R_n = I_n or where the mode is kept whole.
std::vector<Matrix> hosvd_bases(const TensorView& a, const std::vector<std::size_t>& ranks,
                                const OnNsvd& progress = {});

struct Alternation {
  std::vector<std::size_t> ranks;  // R_n = I_n keeps a mode whole, with an empty basis
  std::size_t first = 0;           // the mode that each sweep begins with; its basis need not be given
  int sweeps = 10;
  double tolerance = 1e-4;
};

// Lowers || A - Z x_n U_n ||^2, at least one sweep; what comes out is no worse than the bases that came in.
// squared is || A ||^2.
Nsvd alternate(const TensorView& a, double squared, std::vector<Matrix> bases, const Alternation& settings,
               const OnNsvd& progress = {});

}  // namespace nook::bake::tensor
