// Pictures of a plane that wears a material, as it tiles and by a coordinate texture.
#pragma once

#include "bakers/images/picture.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::measure {

// The part of the material that is put beside itself, in texels.
struct TilePart {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

// Side by side, a pixel for each texel of the plane: the part tiled; the plane by its coordinates; the
// coordinates themselves as red and green, where a piece of the material shows as one ramp. The view is
// tilted by 20 degrees, the light by 45; where the view passes through, the ground is grey.
bake::Picture plane_sheet(const nook::material::MaterialTables& tables,
                          const nook::synthesis::Coordinates& coordinates, const TilePart& part);

}  // namespace nook::measure
