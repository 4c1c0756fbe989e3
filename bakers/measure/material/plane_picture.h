// Draws a plane with a material, once tiled and once by a coordinate texture.
#pragma once

#include "bakers/images/picture.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::measure {

// The part of the material to tile, in texels.
struct TilePart {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

// Draws three panels side by side, one pixel for each texel of the plane. They show the tiled part, the plane
// drawn by its coordinates, and the coordinates as red and green. In the third panel, each piece of the
// material appears as one ramp. The view is tilted by 20 degrees, the light by 45. The ground is grey.
bake::Picture plane_sheet(const nook::material::MaterialTables& tables,
                          const nook::synthesis::Coordinates& coordinates, const TilePart& part);

}  // namespace nook::measure
