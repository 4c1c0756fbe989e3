// The view mode as decoding reads it: for every cell of a parabolic map the clusters and coefficients of that
// direction. A resampled map is taken as it is. Where there is none, the rows of the three nearest views are
// mixed linearly: with the clusters of all three that comes out as a row of up to 3 K terms, so that N-SVD,
// CTA and K-CTA are decoded alike.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "sdk/src/material/material.h"

namespace nook::material {

struct ViewCells {
  explicit ViewCells(std::pmr::memory_resource* memory = std::pmr::get_default_resource()) : rows(memory) {}

  std::uint32_t side = 0;
  std::uint32_t terms = 1;  // clusters of a cell, in the place of K
  ViewRows rows;            // side x side; a term that is not needed has coefficients 0
};

// Terms that cells need: K with a map, min(3 K, C) without: 1 of N-SVD, 3 of CTA.
std::uint32_t cell_terms(const ClusteredTensor& tensor);

// `side` where the tensor has no map of its own.
ViewCells view_cells(const ClusteredTensor& tensor, std::span<const Vec3> views, std::uint32_t side,
                     std::pmr::memory_resource* memory);

}  // namespace nook::material
