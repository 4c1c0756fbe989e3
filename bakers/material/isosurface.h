// The zero surface of a periodic function, by marching tetrahedra.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/material/meso_surface.h"

namespace nook::bake::material {

struct IsoGrid {
  std::uint32_t cells = 64;   // along a tile's side
  std::uint32_t layers = 16;  // cells between bottom and top
  float bottom = -0.1f, top = 0.1f;
};

// field is positive inside, has the period 1 along x and y, and is negative at bottom and top. Normals are
// those of its gradient. albedo is evaluated at each vertex. Opposite sides of the tile match vertex by
// vertex.
MesoSurface extract_isosurface(const std::function<float(Vec3)>& field,
                               const std::function<Vec3(Vec3)>& albedo, const IsoGrid& grid);

}  // namespace nook::bake::material
