#include "sdk/src/material/view_cells.h"

#include <algorithm>
#include <cmath>

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

// Adds `weight` times each term of a view to the term of the same cluster, or to the next unused one.
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

// The terms of one cell of a tensor's map.
struct MapCell {
  const std::uint16_t* membership;
  const float* coefficients;
};

MapCell map_cell(const ClusteredTensor& tensor, std::uint32_t column, std::uint32_t row) {
  const std::size_t first = (std::size_t(row) * tensor.map.side + column) * tensor.shape.mixture;
  return {&tensor.map.rows.membership[first], &tensor.map.rows.coefficients[first * tensor.shape.rank_view]};
}

// Adds `weight` times the coefficients of `from` to a cell of the given clusters. Does nothing and gives
// false where the clusters are others, in any order.
bool add_same_clusters(const TensorShape& s, MapCell from, float weight, Cell cell) {
  const auto* const end = from.membership + s.mixture;
  for (std::uint32_t term = 0; term < s.mixture; ++term)
    if (std::find(from.membership, end, cell.membership[term]) == end) return false;
  for (std::uint32_t term = 0; term < s.mixture; ++term) {
    const auto* const at = std::find(from.membership, end, cell.membership[term]);
    const float* const coefficients = from.coefficients + (at - from.membership) * s.rank_view;
    for (std::uint32_t b = 0; b < s.rank_view; ++b)
      cell.coefficients[term * s.rank_view + b] += weight * coefficients[b];
  }
  return true;
}

// Where the centre of a finer cell lies in a row or column of the map: the map's cell, and the way from its
// centre in cells, -0.5 to 0.5.
struct Place {
  std::uint32_t cell;
  float offset;
};

Place place_of(std::uint32_t fine, std::uint32_t factor) {
  return {fine / factor, (float(fine % factor) + 0.5f) / float(factor) - 0.5f};
}

// Adds what a finer cell takes from the neighbours of its map cell along one direction, and gives the weight
// that it took: from the one it lies towards or, where that has other clusters, from the opposite one with
// the sign turned.
float add_neighbour(const ClusteredTensor& tensor, Place x, Place y, bool along_x, Cell cell) {
  const Place along = along_x ? x : y;
  const int towards = along.offset > 0 ? 1 : -1;
  const float weight = std::abs(along.offset);
  for (const int sign : {1, -1}) {
    const std::int64_t neighbour = std::int64_t(along.cell) + sign * towards;
    if (neighbour < 0 || neighbour >= std::int64_t(tensor.map.side)) continue;
    const auto at = static_cast<std::uint32_t>(neighbour);
    const MapCell from = along_x ? map_cell(tensor, at, y.cell) : map_cell(tensor, x.cell, at);
    if (add_same_clusters(tensor.shape, from, float(sign) * weight, cell)) return float(sign) * weight;
  }
  return 0;
}

// Each cell of a map becomes factor x factor, of its own clusters, with coefficients linear between the
// centres of cells that have the same clusters. Where its neighbours have others it goes on as it comes from
// the opposite side.
void refine(const ClusteredTensor& tensor, std::uint32_t factor, ViewCells& cells) {
  for (std::uint32_t row = 0; row < cells.side; ++row)
    for (std::uint32_t column = 0; column < cells.side; ++column) {
      const Place x = place_of(column, factor), y = place_of(row, factor);
      const MapCell own = map_cell(tensor, x.cell, y.cell);
      const Cell cell = cell_at(cells, std::size_t(row) * cells.side + column, tensor.shape.rank_view);
      std::copy_n(own.membership, tensor.shape.mixture, cell.membership);
      const float taken = add_neighbour(tensor, x, y, true, cell) + add_neighbour(tensor, x, y, false, cell);
      add_same_clusters(tensor.shape, own, 1 - taken, cell);
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
  const std::uint32_t own = tensor.map.side, factor = own == 0 ? 0 : side / own;
  if (own != 0 && factor < 2) {
    cells.side = own;
    cells.rows.membership = tensor.map.rows.membership;
    cells.rows.coefficients = tensor.map.rows.coefficients;
    return cells;
  }
  cells.side = own == 0 ? side : factor * own;
  const std::size_t terms = std::size_t(cells.side) * cells.side * cells.terms;
  cells.rows.membership.resize(terms);
  cells.rows.coefficients.resize(terms * tensor.shape.rank_view);
  if (own == 0)
    mix_three(tensor, views, cells, memory);
  else
    refine(tensor, factor, cells);
  return cells;
}

}  // namespace nook::material
