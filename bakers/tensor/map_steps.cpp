#include "bakers/tensor/map_steps.h"

#include <algorithm>
#include <array>

#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;

// The two cells of a border, each with the one behind it, and the factors by which decoding reaches the
// border from them. A cell without one of the same clusters behind it is constant towards the border.
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

// Borders of cells in a row, step 1, or in a column, step `side`.
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

  // out = (block diagonal of the Gram matrix + penalty times the steps' own) weights.
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
  // Adds factor times the inner products of a cell's mix with all atoms.
  void add_product(const WideMatrix& weights, std::size_t cell, double factor, Eigen::VectorXd& sum) const {
    if (factor == 0) return;
    for (std::size_t k = 0; k < cells_.count; ++k)
      sum += atoms_.product.middleCols(atom(cell, k), rank_) *
             (factor * weights.row(Index(cell)).segment(Index(k) * rank_, rank_).transpose());
  }
  // Adds factor times those of the cell's own atoms.
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
  constexpr double small_enough = 1e-8;  // of the first squared residual
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

}  // namespace nook::bake::tensor
