// Draws a plane with a material, once by tiling the material and once with a coordinate texture.
#pragma once

#include "bakers/images/picture.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::measure {

// The part of the material to tile, in texels.
struct TilePart {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

// Draws three panels side by side, with one pixel for each texel of the plane. The first shows the tiled
// part. The second shows the plane drawn with its coordinate texture. The third shows the coordinates as red
// and green, so that each contiguous piece of the material appears as one colour ramp. The view is tilted by
// 20 degrees, and the light by 45 degrees. The ground is grey.
bake::Picture plane_sheet(const nook::material::MaterialTables& tables,
                          const nook::synthesis::Coordinates& coordinates, const TilePart& part);

}  // namespace nook::measure
