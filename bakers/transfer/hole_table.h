// The share of a material's meso-structure that a straight line meets, tabulated from its VOTF, so that
// millions of rays can ask for it at any size of footprint.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/core/vec.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::transfer {

struct HoleTable {
  std::uint64_t votf_hash = 0;  // of the material
  std::uint32_t side = 0;       // cells of the parabolic map of views
  std::uint32_t width = 0, height = 0, levels = 0;
  // For each cell one level after another, rows of texels: 255 where a line meets the structure, 0 in a hole.
  // Levels are means of the finest, which no level of signed distances would be.
  std::vector<std::uint8_t> cover;

  std::size_t cell_bytes() const;
  // Returns the share that lines along `view` meet around a point of the tile, which repeats. view is a unit
  // vector of tangent space with z >= 0; level is log2 of the footprint's side in texels.
  float cover_at(float u, float v, float level, Vec3 view) const;
};

// Throws Failure(INVALID_ARGUMENT) if the material has no VOTF.
HoleTable make_hole_table(const nook::material::MaterialTables& tables);

}  // namespace nook::bake::transfer
