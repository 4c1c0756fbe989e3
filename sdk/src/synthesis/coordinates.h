// The coordinate texture S of section 6.3.3 of Y.-T. Tsai, Z.-C. Shih: K-Clustered Tensor Approximation,
// 2012, as plain data. It covers a plane that repeats. For each texel of the plane, it stores which texel of
// a material is shown there.
//
// Points of the plane have coordinates in units of the material's tile, so that a texel has the same size on
// the plane as in the material. Inside a texel of the plane, the position in the material varies
// continuously. At the border between two texels of the plane, the picture is continuous if they show
// neighbouring texels of the material.
#pragma once

#include <nook/nook.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
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

// check_sizes throws Failure(code) if a size is out of range. check_coordinates also throws if a cell lies
// outside the material.
void check_sizes(const Coordinates& coordinates, nook_result code);
void check_coordinates(const Coordinates& coordinates, nook_result code);

struct Point {
  float u = 0, v = 0;
};
// Returns the material's texture coordinates at a point of the plane. Both points are in units of the
// material's tile. The coordinates of `plane` must be finite.
Point material_point(const Coordinates& coordinates, Point plane);

// Coordinate textures as .nook files. Version 1 of the kind "SYNT" has the sections
//   HEAD  u16 side of the plane, width and height of the material, in texels
//   CELL  side x side pairs of u16 x, y
//   RECP  recipe

inline constexpr ContainerKind synthesis_kind{four_letters("SYNT"), "synthesis", 1, 1};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_coordinates rejects the coordinates.
std::vector<std::byte> write_coordinates(const Coordinates& coordinates);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates memory in proportion to the file's
// size.
Coordinates read_coordinates(std::span<const std::byte> bytes, Memory* memory = default_memory());

}  // namespace nook::synthesis
