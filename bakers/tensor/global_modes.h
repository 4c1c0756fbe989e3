// Modes with one basis for all clusters (the paper's 5.2).
#pragma once

#include "bakers/tensor/clustered_fit.h"

namespace nook::bake::tensor {

// A_G of equation (23).
struct Reduction {
  std::vector<Matrix> global_basis;  // a mode: I_n x R_n; empty: not global, or of full rank
  Tensor held;                       // A_G where a mode was reduced, else empty
  TensorView view;                   // A_G, or the input itself
  double lost = 0;                   // || A ||^2 - || A_G ||^2, what no cluster can explain
};
// Global bases lower || A - A x_n U_n U_n^T ||^2, n in G; other modes stay whole.
Reduction reduce_global_modes(const TensorView& a, const ClusteredSettings& settings,
                              const OnClustered& progress);

}  // namespace nook::bake::tensor
