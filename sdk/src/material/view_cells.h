// The view mode in the form that decoding reads: clusters and coefficients for the directions of the cells of
// a parabolic map, and the neighbours with which a cell blends. A resampled map of the file stays as it is.
// Between the centres of cells with the same clusters, coefficients are linear, so that even a small map has
// no steps between cells as the view moves. Without a map, the rows of the three nearest views are mixed
// linearly into a row of up to 3 K terms with the clusters of all three. So N-SVD, CTA and K-CTA are decoded
// in the same way.
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
  // The neighbours of each cell; see neighbour_step. Cells blend only with a map of the file; otherwise this
  // is empty. With a map, the terms of a cell are sorted by cluster.
  Vector<std::uint8_t> neighbours;
};

// Returns the number of terms of a cell: K with a map, and min(3 K, C) without. That is 1 for N-SVD and 3 for
// CTA.
std::uint32_t cell_terms(const ClusteredTensor& tensor);

// The result has the cells of the tensor's map, or `side` cells along a side if it has none.
ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     Memory* memory);

// The half of a cell along one axis, of the four halves.
enum class CellHalf : std::uint32_t { left = 0, right = 1, lower = 2, upper = 3 };

// Returns the step, -1, 0 or 1, to the cell with which a point in that half of a cell blends. It is the cell
// on this side if that mixes the same clusters. Otherwise it is the cell on the other side, whose
// coefficients are extrapolated; otherwise none. Two bits of `neighbours` hold a half's step + 1.
constexpr int neighbour_step(std::uint32_t neighbours, CellHalf half) {
  return int(neighbours >> (2 * std::uint32_t(half)) & 3u) - 1;
}

// The cell of a direction and the two neighbours that it blends with.
struct CellBlend {
  std::size_t cell[3];
  float weight[3];  // the sum is 1; 0 for an unused one
};
// place is in cells, from 0 to `side`. neighbours belongs to the cell of place, or is 0x55 for none.
CellBlend blend_at(float place_x, float place_y, std::uint32_t side, std::uint32_t neighbours);
inline constexpr std::uint8_t no_neighbours = 0x55;

}  // namespace nook::material
