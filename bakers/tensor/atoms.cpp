#include "bakers/tensor/atoms.h"

#include <algorithm>
#include <cmath>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/mode_product.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Returns A^(-1/2), or the root of the pseudo-inverse.
MatrixXd inverse_root(const MatrixXd& a, double lowest_share) {
  const SymmetricEigen eigen = symmetric_eigen(a);
  Eigen::VectorXd roots = eigen.values;
  const double lowest = lowest_share * std::max(roots.maxCoeff(), 0.0);
  for (double& r : roots) r = r > lowest ? 1 / std::sqrt(r) : 0;
  return eigen.vectors * roots.asDiagonal() * eigen.vectors.transpose();
}

}  // namespace

DualBasis dual_basis(const Tensor& core, std::size_t mode, double lowest) {
  const MatrixXd unfolded = unfold(core, mode).cast<double>();
  DualBasis dual;
  dual.inverse_root = inverse_root(unfolded * unfolded.transpose(), lowest);
  dual.v = fold((dual.inverse_root * unfolded).cast<float>(), core.dimensions, mode);
  return dual;
}

Tensor join_atoms(const std::vector<ClusteredFit::Cluster>& clusters, const std::vector<DualBasis>& dual,
                  const Dimensions& reduced, std::size_t mode) {
  const std::size_t rank = clusters[0].core.dimensions[mode];
  Dimensions joined = reduced;
  joined[mode] = clusters.size() * rank;
  Tensor atoms(joined);
  const ModeLayout layout = layout_of(joined, mode);
  const std::size_t run = rank * layout.inner;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const Tensor expanded = mode_products(dual[c].v, clusters[c].basis);
    for (std::size_t o = 0; o < layout.outer; ++o)
      std::copy_n(&expanded.data[o * run], run, &atoms.data[(o * clusters.size() + c) * run]);
  }
  return atoms;
}

AtomGram atom_gram(const Tensor& atoms, std::size_t mode, std::size_t clusters) {
  AtomGram gram_of;
  gram_of.clusters = clusters;
  gram_of.rank = atoms.dimensions[mode] / clusters;
  gram_of.product = gram(atoms, mode);
  return gram_of;
}

}  // namespace nook::bake::tensor
