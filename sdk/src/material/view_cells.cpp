#include "sdk/src/material/view_cells.h"

#include <algorithm>

#include "sdk/src/material/direction_mesh.h"
#include "sdk/src/material/map_rows.h"

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

// Adds the terms of a view, times `weight`, to a cell. If the cell already has a term with the same cluster,
// the term is added to it, otherwise to the next unused term.
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

void mix_three(const ClusteredTensor& tensor, std::span<const Vec3> views, ViewCells& cells, Memory* memory) {
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

// Finds the neighbour with which one half of a cell blends. `towards` is -1 or 1, and selects the half. The
// neighbour must mix the same clusters as the cell. Returns step + 1, where the step is -1 or 1 along the
// axis, or 0 if there is no such neighbour. `at` is the cell's index along the axis. `distance` is the offset
// in the arrays from a cell to the next one along the axis.
std::uint32_t step_code(const ViewCells& cells, std::size_t number, std::int64_t at, std::int64_t distance,
                        int towards) {
  const std::uint16_t* const own = &cells.rows.membership[number * cells.terms];
  for (const int step : {towards, -towards}) {
    if (at + step < 0 || at + step >= std::int64_t(cells.side)) continue;
    const auto other = std::size_t(std::int64_t(number) + step * distance) * cells.terms;
    if (std::equal(own, own + cells.terms, &cells.rows.membership[other])) return std::uint32_t(step + 1);
  }
  return 1;
}

void copy_map(const ClusteredTensor& tensor, ViewCells& cells, Memory* memory) {
  const std::size_t side = cells.side;
  cells.rows = sorted_rows(tensor.map.rows, tensor.shape, memory);
  cells.neighbours.resize(side * side);
  for (std::size_t cell = 0; cell < side * side; ++cell) {
    const auto x = std::int64_t(cell % side), y = std::int64_t(cell / side);
    const auto below = std::int64_t(side);
    cells.neighbours[cell] =
        std::uint8_t(step_code(cells, cell, x, 1, -1) | step_code(cells, cell, x, 1, 1) << 2 |
                     step_code(cells, cell, y, below, -1) << 4 | step_code(cells, cell, y, below, 1) << 6);
  }
}

}  // namespace

std::uint32_t cell_terms(const ClusteredTensor& tensor) {
  const TensorShape& s = tensor.shape;
  return tensor.map.side == 0 ? std::min(s.clusters, 3 * s.mixture) : s.mixture;
}

ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     Memory* memory) {
  ViewCells cells(memory);
  cells.terms = cell_terms(tensor);
  const std::uint32_t own = tensor.map.side;
  cells.side = own == 0 ? side : own;
  if (own != 0) {
    copy_map(tensor, cells, memory);
    return cells;
  }
  const std::size_t terms = std::size_t(side) * side * cells.terms;
  cells.rows.membership.resize(terms);
  cells.rows.coefficients.resize(terms * tensor.shape.rank_view);
  mix_three(tensor, views, cells, memory);
  return cells;
}

CellBlend blend_at(float place_x, float place_y, std::uint32_t side, std::uint32_t neighbours) {
  const auto column = std::min(static_cast<std::uint32_t>(place_x), side - 1),
             row = std::min(static_cast<std::uint32_t>(place_y), side - 1);
  const float x = place_x - float(column) - 0.5f, y = place_y - float(row) - 0.5f;
  const int step_x = neighbour_step(neighbours, x > 0 ? CellHalf::right : CellHalf::left),
            step_y = neighbour_step(neighbours, y > 0 ? CellHalf::upper : CellHalf::lower);
  const float weight_x = x * float(step_x), weight_y = y * float(step_y);
  const std::size_t cell = std::size_t(row) * side + column;
  return {{cell, std::size_t(std::int64_t(cell) + step_x),
           std::size_t(std::int64_t(cell) + step_y * std::int64_t(side))},
          {1 - weight_x - weight_y, weight_x, weight_y}};
}

}  // namespace nook::material
