#include "bakers/tensor/resample.h"

#include <algorithm>
#include <array>

#include "bakers/tensor/blocks.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;

// A border, the two cells beside it, and the two cells behind them. Decoding extrapolates to the border from
// the two cells on one side, and these factors do the same. If the cell behind mixes other clusters, its
// factor is 0, and the value is constant up to the border.
struct Border {
  std::array<std::size_t, 4> cell;
  std::array<double, 4> factor;
};

bool same_clusters(const MixedCells& cells, std::size_t a, std::size_t b) {
  const auto first = cells.clusters.begin();
  const auto count = std::ptrdiff_t(cells.count), at_a = std::ptrdiff_t(a) * count,
             at_b = std::ptrdiff_t(b) * count;
  return std::is_permutation(first + at_a, first + at_a + count, first + at_b);
}

// Adds the borders between cells in a row (step 1) or in a column (step `side`).
void add_borders(const MixedCells& cells, std::size_t step, std::vector<Border>& borders) {
  const std::size_t all = cells.side * cells.side;
  const auto place = [&](std::size_t cell) { return step == 1 ? cell % cells.side : cell / cells.side; };
  for (std::size_t a = 0; a + step < all; ++a) {
    const std::size_t b = a + step;
    if (place(a) + 1 >= cells.side || same_clusters(cells, a, b)) continue;
    const bool a_goes_on = place(a) > 0 && same_clusters(cells, a - step, a),
               b_goes_on = place(b) + 1 < cells.side && same_clusters(cells, b, b + step);
    borders.push_back(
        {{a, a_goes_on ? a - step : a, b, b_goes_on ? b + step : b},
         {a_goes_on ? 1.5 : 1, a_goes_on ? -0.5 : 0, b_goes_on ? -1.5 : -1, b_goes_on ? 0.5 : 0}});
  }
}

class StepSystem {
 public:
  StepSystem(const AtomGram& atoms, const MixedCells& cells, double penalty)
      : atoms_(atoms), cells_(cells), rank_(Index(atoms.rank)), penalty_(penalty) {
    add_borders(cells, 1, borders_);
    add_borders(cells, cells.side, borders_);
  }

  bool has_steps() const { return !borders_.empty(); }

  // Computes out = (block diagonal of the Gram matrix + penalty * Gram matrix of the steps) * weights.
  void apply(const WideMatrix& weights, WideMatrix& out) const {
    out.setZero(weights.rows(), weights.cols());
    Eigen::VectorXd sum(atoms_.product.rows());
    for (Index cell = 0; cell < weights.rows(); ++cell) {
      sum.setZero();
      add_product(weights, std::size_t(cell), 1, sum);
      add_part(sum, std::size_t(cell), 1, out);
    }
    for (const Border& border : borders_) {
      sum.setZero();
      for (std::size_t i = 0; i < 4; ++i) add_product(weights, border.cell[i], border.factor[i], sum);
      for (std::size_t i = 0; i < 4; ++i) add_part(sum, border.cell[i], penalty_ * border.factor[i], out);
    }
  }

 private:
  Index atom(std::size_t cell, std::size_t term) const {
    return Index(cells_.clusters[cell * cells_.count + term]) * rank_;
  }
  // Adds to `sum` the inner products of a cell's mix with all atoms, times `factor`.
  void add_product(const WideMatrix& weights, std::size_t cell, double factor, Eigen::VectorXd& sum) const {
    if (factor == 0) return;
    for (std::size_t k = 0; k < cells_.count; ++k)
      sum += atoms_.product.middleCols(atom(cell, k), rank_) *
             (factor * weights.row(Index(cell)).segment(Index(k) * rank_, rank_).transpose());
  }
  // Takes the entries of `sum` for the cell's own atoms, and adds them, times `factor`, to the cell's row of
  // `out`.
  void add_part(const Eigen::VectorXd& sum, std::size_t cell, double factor, WideMatrix& out) const {
    for (std::size_t k = 0; k < cells_.count; ++k)
      out.row(Index(cell)).segment(Index(k) * rank_, rank_) +=
          factor * sum.segment(atom(cell, k), rank_).transpose();
  }

  const AtomGram& atoms_;
  const MixedCells& cells_;
  Index rank_;
  double penalty_;
  std::vector<Border> borders_;
};

WideMatrix own_products(const WideMatrix& products, const MixedCells& cells, Index rank) {
  WideMatrix own(cells.weights.rows(), cells.weights.cols());
  for (Index cell = 0; cell < own.rows(); ++cell)
    for (std::size_t k = 0; k < cells.count; ++k)
      own.row(cell).segment(Index(k) * rank, rank) =
          products.row(cell).segment(Index(cells.clusters[std::size_t(cell) * cells.count + k]) * rank, rank);
  return own;
}

}  // namespace

void lower_steps(const AtomGram& atoms, const WideMatrix& products, double penalty, MixedCells& cells,
                 const RoundProgress& progress) {
  constexpr std::size_t rounds = 300;
  constexpr double small_enough = 1e-8;  // share of the first squared residual
  const StepSystem system(atoms, cells, penalty);
  if (!(penalty > 0) || !system.has_steps()) return;
  WideMatrix rest, along;
  system.apply(cells.weights, rest);
  rest = own_products(products, cells, Index(atoms.rank)) - rest;
  WideMatrix step = rest;
  double left = rest.squaredNorm();
  const double first = left;
  for (std::size_t round = 0; round < rounds && left > small_enough * first; ++round) {
    if (progress && !progress(round, rounds)) throw Failure(NOOK_ERROR_CANCELLED, "stopped");
    system.apply(step, along);
    const double bend = step.cwiseProduct(along).sum();
    if (!(bend > 0)) return;
    const double length = left / bend;
    cells.weights += length * step;
    rest -= length * along;
    const double now = rest.squaredNorm();
    step = rest + now / left * step;
    left = now;
  }
}

namespace {

using Eigen::Index;

// Share of the largest eigenvalue of a core. Smaller eigenvalues are ignored. The members of a cluster hardly
// differ along directions with small eigenvalues, but a sub-tensor between the fitted ones may have a part
// along them. At an eigenvalue share of 1e-12, its coefficient would be a million times as large as in the
// fit. This would ruin the file, which quantises all coefficients of a map relative to the largest one.
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

// Searches for the clusters of each row. The resulting weights are in coordinates of the orthonormal atoms.
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

// Converts weights from the coordinates of V_{m,c} to the coordinates of the core: U = w (uf(Z)
// uf(Z)^T)^(-1/2).
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
                  "the size of the tensor differs from the size of the fitted tensor (%zu and %zu entries)",
                  a.size(), volume(fit.dimensions));
  const Tensor atoms = atoms_of(fit, dual_bases(fit));
  // If no mode is reduced, uses the tensor itself and makes no copy.
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
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the weights have %zu cells, need %zu x %zu",
                  std::size_t(weights.rows()), side, side);
  cells.side = side;
  if (step_penalty > 0)
    lower_steps(of.atoms, (weights * projections).cast<double>(), step_penalty, cells, progress);
  return as_mixture(of, cells);
}

}  // namespace nook::bake::tensor
