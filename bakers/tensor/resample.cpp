#include "bakers/tensor/resample.h"

#include <algorithm>

#include "bakers/tensor/atoms.h"
#include "bakers/tensor/blocks.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/map_steps.h"
#include "bakers/tensor/mode_product.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;

// Of the largest eigenvalue of a core. A sub-tensor between those of the fit has a part along any direction,
// also along those in which the members of a cluster hardly differ; for an eigenvalue of 1e-12 its
// coefficient would be a million times those of the fit, and a file rounds all coefficients of a map by the
// largest.
constexpr double lowest_eigenvalue = 1e-6;

std::vector<DualBasis> dual_bases(const ClusteredFit& fit) {
  std::vector<DualBasis> dual;
  for (const ClusteredFit::Cluster& cluster : fit.clusters)
    dual.push_back(dual_basis(cluster.core, fit.mode, lowest_eigenvalue));
  return dual;
}

Tensor atoms_of(const ClusteredFit& fit, const std::vector<DualBasis>& dual) {
  Dimensions reduced = fit.dimensions;
  for (std::size_t n = 0; n < reduced.size(); ++n)
    if (fit.global_basis[n].size() > 0) reduced[n] = fit.ranks[n];
  return join_atoms(fit.clusters, dual, reduced, fit.mode);
}

// The parts of a fit that resampling reads.
struct Resampling {
  explicit Resampling(const ClusteredFit& fit)
      : dual(dual_bases(fit)),
        atoms(atom_gram(atoms_of(fit, dual), fit.mode, fit.clusters.size())),
        count(fit.mixture.count) {}

  std::vector<DualBasis> dual;
  AtomGram atoms;
  std::size_t count;
};

void check_sizes(const AtomGram& atoms, const Matrix& projections, const Matrix& weights) {
  if (projections.cols() != Index(atoms.clusters * atoms.rank) || weights.cols() != projections.rows())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "projections of %zu x %zu and weights of %zu columns do not fit %zu clusters of rank %zu",
                  std::size_t(projections.rows()), std::size_t(projections.cols()),
                  std::size_t(weights.cols()), atoms.clusters, atoms.rank);
}

// The clusters of each row by search, with weights in the coordinates of the orthonormal atoms.
MixedCells search_rows(const Resampling& of, const Matrix& projections, const Matrix& weights,
                       Pursuit pursuit) {
  const std::size_t rows = std::size_t(weights.rows()), k = of.count;
  MixedCells cells;
  cells.count = k;
  cells.clusters.resize(rows * k);
  cells.weights.resize(Index(rows), Index(k * of.atoms.rank));
  for_each_block(rows, 256, [&](std::size_t first, std::size_t last) {
    const Matrix mixed = weights.middleRows(Index(first), Index(last - first)) * projections;
    for (std::size_t i = first; i < last; ++i) {
      const SubTensorMix mix =
          search(pursuit, of.atoms, mixed.row(Index(i - first)).cast<double>().transpose(), k);
      std::copy(mix.clusters.begin(), mix.clusters.end(), cells.clusters.begin() + std::ptrdiff_t(i * k));
      cells.weights.row(Index(i)) = mix.weights.transpose();
    }
  });
  return cells;
}

// From coordinates of V_{m,c} to those of the core: U = w (uf(Z) uf(Z)^T)^(-1/2).
Mixture as_mixture(const Resampling& of, const MixedCells& cells) {
  const auto rank = Index(of.atoms.rank);
  Mixture mixture;
  mixture.count = cells.count;
  mixture.membership = cells.clusters;
  mixture.coefficients.resize(cells.weights.rows(), cells.weights.cols());
  for (Index i = 0; i < cells.weights.rows(); ++i)
    for (std::size_t j = 0; j < cells.count; ++j)
      mixture.coefficients.block(i, Index(j) * rank, 1, rank) =
          (cells.weights.row(i).segment(Index(j) * rank, rank) *
           of.dual[cells.clusters[std::size_t(i) * cells.count + j]].inverse_root)
              .cast<float>();
  return mixture;
}

}  // namespace

Matrix atom_projections(const ClusteredFit& fit, const TensorView& a) {
  if (a.dimensions != fit.dimensions)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the tensor is not of the size that was fitted (%zu and %zu entries)", a.size(),
                  volume(fit.dimensions));
  const Tensor atoms = atoms_of(fit, dual_bases(fit));
  // Nothing to reduce: the tensor itself, uncopied.
  const auto is_empty = [](const Matrix& u) { return u.size() == 0; };
  if (std::all_of(fit.global_basis.begin(), fit.global_basis.end(), is_empty))
    return cross_gram(a, atoms, fit.mode).cast<float>();
  return cross_gram(project(a, fit.global_basis), atoms, fit.mode).cast<float>();
}

Mixture resample(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights, Pursuit pursuit) {
  const Resampling of(fit);
  check_sizes(of.atoms, projections, weights);
  return as_mixture(of, search_rows(of, projections, weights, pursuit));
}

Mixture resample_map(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                     std::size_t side, double step_penalty, Pursuit pursuit, const RoundProgress& progress) {
  const Resampling of(fit);
  check_sizes(of.atoms, projections, weights);
  MixedCells cells = search_rows(of, projections, weights, pursuit);
  if (side * side != std::size_t(weights.rows()))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "weights of %zu cells, need %zu x %zu",
                  std::size_t(weights.rows()), side, side);
  cells.side = side;
  if (step_penalty > 0)
    lower_steps(of.atoms, (weights * projections).cast<double>(), step_penalty, cells, progress);
  return as_mixture(of, cells);
}

}  // namespace nook::bake::tensor
