// Draws a material, and the errors of its compression.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/images/picture.h"
#include "bakers/material/raw_material.h"
#include "bakers/measure/material/view_errors.h"
#include "sdk/src/material/material.h"

namespace nook::measure {

// Draws a grid: one column per view, with growing tilt; one row for each of three lights; and the visibility
// as the last row. The tile is repeated twice along each axis, so that a seam would show. The ground is grey.
bake::Picture raw_sheet(const bake::material::RawMaterial& raw);

// Draws two views, one near the normal and one tilted. For each, it shows raw, decoded, and the absolute
// difference times three (the seed's Figure 3). Below are the visibility of both, and where the two differ.
bake::Picture difference_sheet(const bake::material::RawMaterial& raw,
                               const nook::material::Material& material);

// Draws materials that were compressed from one raw material, in columns beside the raw one. The view is
// tilted by 55 degrees, the light by 45. Below is the absolute difference times three (the seed's Figure 3).
bake::Picture methods_sheet(const bake::material::RawMaterial& raw,
                            std::span<const nook::material::Material> materials);

// Draws the largest step that measure_view_jumps found: the material before and after the step, and the
// absolute difference times ten. The light is tilted by 45 degrees. The tile is repeated twice along each
// axis.
bake::Picture jump_strip(const nook::material::Material& material, const bake::material::ViewJumps& jumps);

bake::Picture below_each_other(std::span<const bake::Picture> pictures);

}  // namespace nook::measure
