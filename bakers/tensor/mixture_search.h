// The clustering stage for one sub-tensor: chooses clusters and their coefficients.
//
// All coordinates refer to the dual bases V_{m,c} of equation (7), whose rows are orthonormal. The atoms of
// cluster c are O_c = fold(V_{m,c}) x_{n != m} U_{n,c}, and a sub-tensor is sum_k w_k O_{c_k}. So the search
// needs only inner products. With p_c = <A_<m_i>, O_c>, equations (9), (11), (13), (15) become
//   (9)   max || p_c ||^2
//   (11)  w = p_c
//   (13)  max || p_c - sum_j w_j <O_{c_j}, O_c> ||^2  (the proof, (34), has V of the new cluster c_{i_k} in
//         the second term, where (13) prints V of c_{i_j})
//   (15)  w = <O, O>^+ p over the chosen clusters.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/tensor/clustered_fit.h"

namespace nook::bake::tensor {

struct AtomGram {
  std::size_t clusters = 0, rank = 0;  // C, R_m
  Eigen::MatrixXd product;             // (C R_m) x (C R_m): <O_c, O_d>
};

struct SubTensorMix {
  std::vector<std::uint32_t> clusters;
  Eigen::VectorXd weights;  // R_m per cluster
  double explained = 0;     // by how much the mix lowers || A_<m_i> ||^2
};

// Projects a sub-tensor onto the given clusters with the smallest error (15). `products` are its inner
// products with all atoms (C R_m).
SubTensorMix project_on(const AtomGram& atoms, const Eigen::VectorXd& products,
                        std::vector<std::uint32_t> clusters);

// Of the clusters that are not yet in the mix, returns the best one by (13).
std::uint32_t next_cluster(const AtomGram& atoms, const Eigen::VectorXd& products, const SubTensorMix& mix);

SubTensorMix search_greedy(const AtomGram& atoms, const Eigen::VectorXd& products, std::size_t mixture);
// Replaces single clusters of the mix. For one cluster of the mix after another, tries the best other
// cluster, until no replacement lowers the error.
SubTensorMix exchange(const AtomGram& atoms, const Eigen::VectorXd& products, SubTensorMix mix);

SubTensorMix search_exhaustive(const AtomGram& atoms, const Eigen::VectorXd& products, std::size_t mixture);

SubTensorMix search(Pursuit pursuit, const AtomGram& atoms, const Eigen::VectorXd& products,
                    std::size_t mixture);

// Share of the largest eigenvalue of uf(Z) uf(Z)^T. Smaller eigenvalues are only rounding errors of a core in
// floats.
inline constexpr double rounded_eigenvalue = 1e-12;

// V_{m,c} of equation (7), folded like the core, and the transformation (uf(Z) uf(Z)^T)^(-1/2). If the core
// does not have full rank, the transformation is the root of the pseudo-inverse, and the rows of V span fewer
// dimensions.
struct DualBasis {
  Tensor v;                      // R_1 x ... x R_N
  Eigen::MatrixXd inverse_root;  // R_m x R_m
};
// V omits directions whose eigenvalue is less than `lowest` times the largest eigenvalue.
DualBasis dual_basis(const Tensor& core, std::size_t mode, double lowest = rounded_eigenvalue);

// Returns O_c = V_{m,c} x_{n != m} U_{n,c} of all clusters, joined along mode m, which then has size C R_m.
// Global modes stay reduced. The paper instead projects every sub-tensor onto the bases of each cluster, (10)
// and (14). Our way gives the same inner products at a lower cost, because a cluster has few atoms.
Tensor join_atoms(const std::vector<ClusteredFit::Cluster>& clusters, const std::vector<DualBasis>& dual,
                  const Dimensions& reduced, std::size_t mode);

AtomGram atom_gram(const Tensor& atoms, std::size_t mode, std::size_t clusters);

}  // namespace nook::bake::tensor
