// The view mode in the form that decoding reads: the clusters and coefficients of the directions of the cells
// of a parabolic map, and the neighbours with which a cell blends. A resampled map of the file stays as it
// is: between the centres of cells that mix the same clusters the coefficients are linear, so that a small
// map does not give steps from cell to cell as the view moves. Without a map, the rows of the three nearest
// views are mixed linearly, which gives a row of up to 3 K terms with the clusters of all three. So N-SVD,
// CTA and K-CTA are decoded in the same way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/memory.h"
#include "sdk/src/material/material.h"

namespace nook::material {

struct ViewCells {
  explicit ViewCells(Memory* memory = default_memory()) : rows(memory), neighbours(memory) {}

  std::uint32_t side = 0;
  std::uint32_t terms = 1;  // clusters of a cell, which replaces K
  ViewRows rows;            // side x side; an unused term has coefficients 0
  // The neighbours of each cell, see neighbour_step; empty without a map of the file, whose cells do not
  // blend. Terms of a cell are in the order of their clusters there.
  Vector<std::uint8_t> neighbours;
};

// Returns the number of terms of a cell: K with a map, and min(3 K, C) without one, which is 1 for N-SVD and
// 3 for CTA.
std::uint32_t cell_terms(const ClusteredTensor& tensor);

// The result has the cells of the tensor's map, or `side` cells along a side if it has none.
ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     Memory* memory);

// The half of a cell along one axis, of the four halves.
enum class CellHalf : std::uint32_t { left = 0, right = 1, lower = 2, upper = 3 };

// Returns the step, -1, 0 or 1, to the cell with which a point in that half of a cell blends: the one on this
// side if it mixes the same clusters; else the one on the other side, from which the coefficients go on; else
// none. Two bits of `neighbours` hold a half's step + 1.
constexpr int neighbour_step(std::uint32_t neighbours, CellHalf half) {
  return int(neighbours >> (2 * std::uint32_t(half)) & 3u) - 1;
}

// The cell of a direction and the two neighbours that it blends with.
struct CellBlend {
  std::size_t cell[3];
  float weight[3];  // the sum is 1; 0 for an unused one
};
// place is in cells, from 0 to `side`; neighbours are those of the cell of place, or 0x55 for none.
CellBlend blend_at(float place_x, float place_y, std::uint32_t side, std::uint32_t neighbours);
inline constexpr std::uint8_t no_neighbours = 0x55;

}  // namespace nook::material
