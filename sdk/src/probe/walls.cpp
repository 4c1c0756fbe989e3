#include "sdk/src/probe/walls.h"

#include "sdk/src/core/floats.h"

namespace nook::probe {

std::size_t side_of(const CellWalls& cell, Vec3 in_cell) {
  std::size_t side = 0;
  for (std::size_t k = 0; k < wall_planes; ++k)
    if (dot(cell.plane[k].normal, in_cell) + cell.plane[k].offset < 0) side |= std::size_t(1) << k;
  return side;
}

WallPlane stored(const WallPlane& plane) {
  const auto half = [](float value) { return from_half(to_half(value)); };
  return {{half(plane.normal.x), half(plane.normal.y), half(plane.normal.z)}, half(plane.offset)};
}

}  // namespace nook::probe
