// Pictures of a material, and of what compression did to it.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/images/picture.h"
#include "bakers/material/raw_material.h"
#include "bakers/measure/material/view_errors.h"
#include "sdk/src/material/material.h"

namespace nook::measure {

// Views of growing tilt side by side, three lights below each other, the visibility as the last row; tiles
// twice each way, so that a seam would show. Where a view passes through, the ground is grey.
bake::Picture raw_sheet(const bake::material::RawMaterial& raw);

// For a view near the normal and a tilted one: raw, decoded, and the absolute difference three times (the
// seed's Figure 3); below them the visibility of both and where it differs.
bake::Picture difference_sheet(const bake::material::RawMaterial& raw,
                               const nook::material::Material& material);

// Materials that were compressed from one raw material, in columns beside it: a view tilted by 55 degrees
// under a light tilted by 45, below it the absolute difference three times (the seed's Figure 3).
bake::Picture methods_sheet(const bake::material::RawMaterial& raw,
                            std::span<const nook::material::Material> materials);

// A step of the view of view_errors.h: the material as it is drawn before and after it, and the absolute
// difference ten times, for a light tilted by 45 degrees; two tiles each way.
bake::Picture jump_strip(const nook::material::Material& material, const bake::material::ViewJumps& jumps);

// Pictures of equal width in a column.
bake::Picture below_each_other(std::span<const bake::Picture> pictures);

}  // namespace nook::measure
