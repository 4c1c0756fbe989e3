// Draws a material, and the errors of its compression.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/images/picture.h"
#include "bakers/material/raw_material.h"
#include "bakers/measure/material/view_errors.h"
#include "sdk/src/material/material.h"

namespace nook::measure {

// Draws a grid of pictures. There is one column per view, in the order of increasing tilt. There is one row
// for each of three lights, and a last row for the visibility. The tile is repeated twice along each axis, so
// that a seam would be visible. The ground below the material is grey.
bake::Picture raw_sheet(const bake::material::RawMaterial& raw);

// Draws two views, one near the normal and one tilted. For each view, it shows the raw material, the decoded
// material, and their absolute difference times three (as in Figure 3 of the paper). Below, it shows the
// visibility of both, and the texels in which they differ.
bake::Picture difference_sheet(const bake::material::RawMaterial& raw,
                               const nook::material::Material& material);

// Draws several compressed versions of one raw material in columns beside the raw material. The view is
// tilted by 55 degrees, and the light by 45 degrees. Below each, it shows the absolute difference times three
// (as in Figure 3 of the paper).
bake::Picture methods_sheet(const bake::material::RawMaterial& raw,
                            std::span<const nook::material::Material> materials);

// Draws the largest step of the view that measure_view_jumps found: the material before the step, the
// material after the step, and their absolute difference times ten. The light is tilted by 45 degrees. The
// tile is repeated twice along each axis.
bake::Picture jump_strip(const nook::material::Material& material, const bake::material::ViewJumps& jumps);

bake::Picture below_each_other(std::span<const bake::Picture> pictures);

}  // namespace nook::measure
