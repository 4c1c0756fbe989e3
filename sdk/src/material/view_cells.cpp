#include "sdk/src/material/view_cells.h"

#include <algorithm>

#include "sdk/src/material/direction_mesh.h"

namespace nook::material {
namespace {

struct Cell {
  std::uint16_t* membership;
  float* coefficients;
};

Cell cell_at(ViewCells& cells, std::size_t number, std::uint32_t rank) {
  return {&cells.rows.membership[number * cells.terms],
          &cells.rows.coefficients[number * cells.terms * rank]};
}

// Adds `weight` times each term of a view to the term of the same cluster, or to the next free one.
void add_terms(const ClusteredTensor& tensor, std::size_t view, float weight, Cell cell,
               std::uint32_t& used) {
  const std::uint32_t rank = tensor.shape.rank_view, mixture = tensor.shape.mixture;
  for (std::size_t row = view * mixture; row < (view + 1) * mixture; ++row) {
    const std::uint16_t cluster = tensor.rows.membership[row];
    const auto* const term = std::find(cell.membership, cell.membership + used, cluster);
    const auto number = static_cast<std::uint32_t>(term - cell.membership);
    if (number == used) cell.membership[used++] = cluster;
    for (std::uint32_t b = 0; b < rank; ++b)
      cell.coefficients[number * rank + b] += weight * tensor.rows.coefficients[row * rank + b];
  }
}

void mix_three(const ClusteredTensor& tensor, std::span<const Vec3> views, ViewCells& cells,
               std::pmr::memory_resource* memory) {
  const DirectionMesh mesh(views, memory);
  std::size_t hint = 0;
  for (std::uint32_t row = 0; row < cells.side; ++row)
    for (std::uint32_t column = 0; column < cells.side; ++column) {
      const Vec3 direction = from_parabolic(cell_centre(column, row, cells.side));
      const DirectionMix mix = mesh.locate(to_parabolic(direction), hint);
      std::uint32_t used = 0;
      for (int i = 0; i < 3; ++i)
        if (mix.weight[i] > 0)
          add_terms(tensor, mix.index[i], mix.weight[i],
                    cell_at(cells, std::size_t(row) * cells.side + column, tensor.shape.rank_view), used);
    }
}

}  // namespace

std::uint32_t cell_terms(const ClusteredTensor& tensor) {
  const TensorShape& s = tensor.shape;
  return tensor.map.side == 0 ? std::min(s.clusters, 3 * s.mixture) : s.mixture;
}

ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     std::pmr::memory_resource* memory) {
  ViewCells cells(memory);
  cells.terms = cell_terms(tensor);
  if (tensor.map.side != 0) {
    cells.side = tensor.map.side;
    cells.rows.membership = tensor.map.rows.membership;
    cells.rows.coefficients = tensor.map.rows.coefficients;
    return cells;
  }
  cells.side = side;
  const std::size_t terms = std::size_t(side) * side * cells.terms;
  cells.rows.membership.resize(terms);
  cells.rows.coefficients.resize(terms * tensor.shape.rank_view);
  mix_three(tensor, views, cells, memory);
  return cells;
}

}  // namespace nook::material
