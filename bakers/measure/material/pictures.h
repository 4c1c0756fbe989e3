// Pictures of a material, and of what compression did to it.
#pragma once

#include <filesystem>

#include "bakers/images/picture.h"
#include "bakers/material/raw_material.h"
#include "sdk/src/material/material.h"

namespace nook::measure {

// Views of growing tilt side by side, three lights below each other, the visibility as the last row; tiles
// twice each way, so that a seam would show. Where a view passes through, the ground is grey.
bake::Picture raw_sheet(const bake::material::RawMaterial& raw);

// For a view near the normal and a tilted one: raw, decoded, and the absolute difference three times (the
// seed's Figure 3); below them the visibility of both and where it differs.
bake::Picture difference_sheet(const bake::material::RawMaterial& raw,
                               const nook::material::Material& material);

// The largest jump of view_jumps.h: the material before and after the step of the view, and the absolute
// difference ten times, for a light tilted by 45 degrees; two tiles each way.
bake::Picture jump_strip(const nook::material::Material& material);

}  // namespace nook::measure
