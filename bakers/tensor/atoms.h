// The dual bases of clusters and their atoms.
#pragma once

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/mixture_search.h"

namespace nook::bake::tensor {

// Relative to the largest eigenvalue of uf(Z) uf(Z)^T; smaller eigenvalues are rounding of a core in floats.
inline constexpr double rounded_eigenvalue = 1e-12;

// V_{m,c} of equation (7), folded like the core, and the inverse transformation (uf(Z) uf(Z)^T)^(-1/2). If
// the core lacks rank, the root is that of the pseudo-inverse, and rows of V span fewer dimensions.
struct DualBasis {
  Tensor v;                      // R_1 x ... x R_N
  Eigen::MatrixXd inverse_root;  // R_m x R_m
};
// Directions whose eigenvalue is below `lowest` of the largest are left out of V.
DualBasis dual_basis(const Tensor& core, std::size_t mode, double lowest = rounded_eigenvalue);

// Returns O_c = V_{m,c} x_{n != m} U_{n,c} of all clusters, joined along mode m, whose size is C R_m. Global
// modes stay reduced. Expanding the few atoms of a cluster costs less than projecting every sub-tensor on its
// bases, as in (10) and (14), and gives the same inner products.
Tensor join_atoms(const std::vector<ClusteredFit::Cluster>& clusters, const std::vector<DualBasis>& dual,
                  const Dimensions& reduced, std::size_t mode);

AtomGram atom_gram(const Tensor& atoms, std::size_t mode, std::size_t clusters);

}  // namespace nook::bake::tensor
