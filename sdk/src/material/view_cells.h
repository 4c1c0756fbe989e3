// The view mode in the form that decoding reads: the clusters and coefficients of the direction of each cell
// of a parabolic map. A resampled map that is coarser than this is refined, so that a small map in a file
// does not give steps from cell to cell as the view moves. Without a map, the rows of the three nearest views
// are mixed linearly, which gives a row of up to 3 K terms with the clusters of all three. So N-SVD, CTA and
// K-CTA are decoded in the same way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/memory.h"
#include "sdk/src/material/material.h"

namespace nook::material {

struct ViewCells {
  explicit ViewCells(Memory* memory = default_memory()) : rows(memory) {}

  std::uint32_t side = 0;
  std::uint32_t terms = 1;  // clusters of a cell, which replaces K
  ViewRows rows;            // side x side; an unused term has coefficients 0
};

// Returns the number of terms of a cell: K with a map, and min(3 K, C) without one, which is 1 for N-SVD and
// 3 for CTA.
std::uint32_t cell_terms(const ClusteredTensor& tensor);

// The result has `side` cells along a side, or, if the tensor has a map, the largest multiple of the map's
// side that is not above `side`, and at least the map's side.
ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     Memory* memory);

}  // namespace nook::material
