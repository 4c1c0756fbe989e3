#include "bakers/tensor/mixture_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A share of the largest eigenvalue. Products are summed in floats, so we treat clusters as linearly
// dependent along directions with a smaller eigenvalue.
constexpr double dependence = 1e-6;

VectorXd solve_by_pseudo_inverse(const MatrixXd& gram, const VectorXd& products) {
  const SymmetricEigen eigen = symmetric_eigen(gram);
  const VectorXd& values = eigen.values;
  const double least = dependence * values.cwiseAbs().maxCoeff();
  VectorXd rotated = eigen.vectors.transpose() * products;
  for (Index i = 0; i < rotated.size(); ++i) rotated[i] = values[i] > least ? rotated[i] / values[i] : 0;
  return eigen.vectors * rotated;
}

VectorXd solve(const MatrixXd& gram, const VectorXd& products) {
  const Eigen::LLT<MatrixXd> factor(gram);
  // Atoms have norm 1. A small pivot shows that an atom depends linearly on the atoms before it.
  if (factor.info() == Eigen::Success &&
      factor.matrixLLT().diagonal().array().square().minCoeff() > 10 * dependence)
    return factor.solve(products);
  return solve_by_pseudo_inverse(gram, products);
}

}  // namespace

SubTensorMix project_on(const AtomGram& atoms, const VectorXd& products,
                        std::vector<std::uint32_t> clusters) {
  const Index rank = Index(atoms.rank), count = Index(clusters.size());
  MatrixXd gram(count * rank, count * rank);
  VectorXd chosen(count * rank);
  for (Index j = 0; j < count; ++j) {
    const Index c = Index(clusters[std::size_t(j)]) * rank;
    chosen.segment(j * rank, rank) = products.segment(c, rank);
    for (Index k = 0; k < count; ++k)
      gram.block(j * rank, k * rank, rank, rank) =
          atoms.product.block(c, Index(clusters[std::size_t(k)]) * rank, rank, rank);
  }
  SubTensorMix mix;
  mix.weights = solve(gram, chosen);
  // || A ||^2 - || A - sum w O ||^2. This equals w . p if w solves the normal equations exactly.
  mix.explained = 2 * mix.weights.dot(chosen) - mix.weights.dot(gram * mix.weights);
  mix.clusters = std::move(clusters);
  return mix;
}

std::uint32_t next_cluster(const AtomGram& atoms, const VectorXd& products, const SubTensorMix& mix) {
  const Index rank = Index(atoms.rank);
  VectorXd left = products;
  for (std::size_t j = 0; j < mix.clusters.size(); ++j)
    left -= atoms.product.middleCols(Index(mix.clusters[j]) * rank, rank) *
            mix.weights.segment(Index(j) * rank, rank);
  std::uint32_t best = 0;
  double greatest = -1;
  for (std::uint32_t c = 0; c < atoms.clusters; ++c) {
    if (std::find(mix.clusters.begin(), mix.clusters.end(), c) != mix.clusters.end()) continue;
    const double gain = left.segment(Index(c) * rank, rank).squaredNorm();
    if (gain <= greatest) continue;
    greatest = gain;
    best = c;
  }
  return best;
}

SubTensorMix search_greedy(const AtomGram& atoms, const VectorXd& products, std::size_t mixture) {
  SubTensorMix mix;
  for (std::size_t k = 0; k < mixture; ++k) {
    std::vector<std::uint32_t> clusters = mix.clusters;
    clusters.push_back(next_cluster(atoms, products, mix));
    mix = project_on(atoms, products, std::move(clusters));
  }
  return mix;
}

SubTensorMix exchange(const AtomGram& atoms, const VectorXd& products, SubTensorMix mix) {
  const std::size_t count = mix.clusters.size();
  // Stops after `count` exchanges in a row without a gain.
  for (std::size_t k = 0, idle = 0; idle < count; k = (k + 1) % count) {
    SubTensorMix best = mix;
    for (std::uint32_t c = 0; c < atoms.clusters; ++c) {
      if (std::find(mix.clusters.begin(), mix.clusters.end(), c) != mix.clusters.end()) continue;
      std::vector<std::uint32_t> clusters = mix.clusters;
      clusters[k] = c;
      SubTensorMix other = project_on(atoms, products, std::move(clusters));
      // The gain must exceed the rounding error. Otherwise, two equally good mixes would replace each other
      // forever.
      if (other.explained > best.explained * (1 + 1e-9)) best = std::move(other);
    }
    idle = best.clusters == mix.clusters ? idle + 1 : 0;
    mix = std::move(best);
  }
  return mix;
}

SubTensorMix search_exhaustive(const AtomGram& atoms, const VectorXd& products, std::size_t mixture) {
  // Tries all sets in lexicographic order. Of equally good sets, takes the first one.
  std::vector<std::uint32_t> set(mixture);
  std::iota(set.begin(), set.end(), 0u);
  SubTensorMix best = project_on(atoms, products, set);
  const auto last = [&](std::size_t k) { return std::uint32_t(atoms.clusters - mixture + k); };
  for (;;) {
    std::size_t k = mixture;
    while (k > 0 && set[k - 1] == last(k - 1)) --k;
    if (k == 0) return best;
    ++set[k - 1];
    for (; k < mixture; ++k) set[k] = set[k - 1] + 1;
    SubTensorMix mix = project_on(atoms, products, set);
    if (mix.explained > best.explained) best = std::move(mix);
  }
}

SubTensorMix search(Pursuit pursuit, const AtomGram& atoms, const VectorXd& products, std::size_t mixture) {
  if (pursuit == Pursuit::exhaustive) return search_exhaustive(atoms, products, mixture);
  SubTensorMix mix = search_greedy(atoms, products, mixture);
  return pursuit == Pursuit::exchange ? exchange(atoms, products, std::move(mix)) : mix;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Returns A^(-1/2). If A is singular, returns the root of the pseudo-inverse.
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
