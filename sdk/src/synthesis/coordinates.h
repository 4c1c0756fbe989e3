// The coordinate texture S of section 6.3.3 of Y.-T. Tsai, Z.-C. Shih: K-Clustered Tensor Approximation,
// 2012, as plain data: for each texel of a periodic plane the texel of a material that is shown there.
//
// A point of the plane has coordinates in tiles of the material, so that it moves over as many texels as it
// would without the texture. Within a texel of the plane the point moves through the material as well, and
// where neighbours of the plane are neighbours in the material the picture is continuous.
#pragma once

#include <nook/nook.h>

#include <cstdint>

#include "sdk/src/core/containers.h"

namespace nook::synthesis {

inline constexpr std::uint32_t max_side = 4096;       // texels of the plane
inline constexpr std::uint32_t max_tile_side = 1024;  // texels of the material

// A texel of the material.
struct Cell {
  std::uint16_t x = 0, y = 0;
  bool operator==(const Cell&) const = default;
};

struct Coordinates {
  explicit Coordinates(Memory* memory = default_memory()) : cells(memory), recipe(memory) {}

  std::uint32_t side = 0;               // texels along a side of the plane, which repeats after them
  std::uint32_t width = 0, height = 0;  // texels of the material
  Vector<Cell> cells;                   // side x side, row by row from v = 0 on
  String recipe;                        // settings of the bake, JSON; the runtime does not read it
};

// Throws Failure(code) if a size is out of range, or a cell lies outside the material.
void check_sizes(const Coordinates& coordinates, nook_result code);
void check_coordinates(const Coordinates& coordinates, nook_result code);

struct Point {
  float u = 0, v = 0;
};
// Returns the material's texture coordinates at a point of the plane, both in tiles of the material; u and v
// of the plane are finite.
Point material_point(const Coordinates& coordinates, Point plane);

}  // namespace nook::synthesis
