// The view mode in the form that the decoder reads. It is a parabolic map, which stores for each cell its
// clusters, its coefficients, and the neighbours with which the cell blends. If the file contains a resampled
// map, its cells are copied. Coefficients are interpolated linearly between the centres of cells that mix the
// same clusters. So even a small map shows no visible steps between cells when the view moves. If the file
// has no map, the rows of the three nearest views are mixed linearly into one row for each cell. The row has
// up to 3 K terms, with the clusters of all three views. So N-SVD, CTA and K-CTA are decoded in the same way.
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
  std::uint32_t terms = 1;  // the number of clusters that a cell mixes; replaces K
  ViewRows rows;            // side x side; an unused term has coefficients 0
  // The neighbours of each cell; see neighbour_step. Cells blend only if the map comes from the file;
  // otherwise this array is empty. In a map from the file, the terms of a cell are sorted by cluster.
  Vector<std::uint8_t> neighbours;
};

// Returns the number of terms of a cell. If the tensor has a map, this is K. Otherwise it is min(3 K, C): 1
// for N-SVD, and up to 3 for CTA.
std::uint32_t cell_terms(const ClusteredTensor& tensor);

// The result has as many cells as the tensor's map, or side x side cells if the tensor has no map.
ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     Memory* memory);

// One of the four halves of a cell. The first two are the halves at low x and high x. The other two
// are the halves at low y and high y.
enum class CellHalf : std::uint32_t { left = 0, right = 1, lower = 2, upper = 3 };

// Returns the step (-1, 0 or 1) to the cell with which a point in this half of a cell blends. If the cell on
// the same side mixes the same clusters, the point blends with it. If instead the cell on the opposite side
// mixes the same clusters, the coefficients are extrapolated from that cell. If neither cell mixes the same
// clusters, the step is 0, and the point does not blend. `neighbours` stores step + 1 in two bits for each
// half.
constexpr int neighbour_step(std::uint32_t neighbours, CellHalf half) {
  return int(neighbours >> (2 * std::uint32_t(half)) & 3u) - 1;
}

// The cell that contains a direction, and the two neighbours with which it blends.
struct CellBlend {
  std::size_t cell[3];
  float weight[3];  // the weights sum to 1; an unused cell has the weight 0
};
// The place is in units of cells, from 0 to `side`. `neighbours` is the value of the cell that contains the
// place, or no_neighbours.
CellBlend blend_at(float place_x, float place_y, std::uint32_t side, std::uint32_t neighbours);
inline constexpr std::uint8_t no_neighbours = 0x55;

}  // namespace nook::material
