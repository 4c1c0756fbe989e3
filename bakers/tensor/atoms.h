// The dual bases of clusters and the atoms that they stand for.
#pragma once

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/mixture_search.h"

namespace nook::bake::tensor {

// V_{m,c} of equation (7), folded as the core is, and what leads back: (uf(Z) uf(Z)^T)^(-1/2). Where the core
// lacks rank, the root is that of the pseudo-inverse and rows of V fall to fewer dimensions.
struct DualBasis {
  Tensor v;                      // R_1 x ... x R_N
  Eigen::MatrixXd inverse_root;  // R_m x R_m
};
DualBasis dual_basis(const Tensor& core, std::size_t mode);

// O_c = V_{m,c} x_{n != m} U_{n,c} of all clusters, joined along mode m: its size there is C R_m. Global
// modes stay reduced. To expand the few atoms of a cluster costs less than to project every sub-tensor on its
// bases, as (10) and (14) have it, and their inner products are the same numbers.
Tensor join_atoms(const std::vector<ClusteredFit::Cluster>& clusters, const std::vector<DualBasis>& dual,
                  const Dimensions& reduced, std::size_t mode);

AtomGram atom_gram(const Tensor& atoms, std::size_t mode, std::size_t clusters);

}  // namespace nook::bake::tensor
