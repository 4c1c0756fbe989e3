// Walls inside the cells of a grid: which of a cell's eight probes count at a place, so that light of one
// room does not reach the next. A cell lies between eight probes; the outermost ones reach beyond them
// without end.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "shaders/probe/constants.h"

namespace nook::probe {

inline constexpr std::size_t wall_planes = NOOK_GRID_PLANES, wall_sides = NOOK_GRID_SIDES;

// A plane in the coordinates of its cell, in spacings from the cell's first probe: a place is behind it where
// dot(normal, place) + offset < 0. Behind the default there is nothing.
struct WallPlane {
  Vec3 normal;
  float offset = 1;
  bool operator==(const WallPlane&) const = default;
};

// Planes cut a cell into sides. Bit k of a side's number is 1 behind plane k, and bit c of its mask is 1 if
// the probe at corner c counts there; x is bit 0 of c, y bit 1 and z bit 2.
struct CellWalls {
  std::array<WallPlane, wall_planes> plane;
  std::array<std::uint8_t, wall_sides> counts{all_corners, all_corners, all_corners, all_corners,
                                              all_corners, all_corners, all_corners, all_corners};

  static constexpr std::uint8_t all_corners = 255;
  // Has no effect on interpolation.
  bool open() const {
    for (const std::uint8_t mask : counts)
      if (mask != all_corners) return false;
    return true;
  }
  bool operator==(const CellWalls&) const = default;
};

std::size_t side_of(const CellWalls& cell, Vec3 in_cell);

// The number that a plane has after it went through half floats, as files and textures hold it.
WallPlane stored(const WallPlane& plane);

struct GridWalls {
  explicit GridWalls(Memory* memory = default_memory()) : cell(memory) {}
  Vector<CellWalls> cell;  // x fastest, then y, z; empty: interpolation ignores walls
  float bias = 0;  // metres along the surface's normal, by which a place is moved before it is looked up

  bool any() const { return !cell.empty(); }
};

}  // namespace nook::probe
