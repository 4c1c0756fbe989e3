// Draws a material, and what compression did to it.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/images/picture.h"
#include "bakers/material/raw_material.h"
#include "bakers/measure/material/view_errors.h"
#include "sdk/src/material/material.h"

namespace nook::measure {

// Draws views of growing tilt side by side, under three lights below each other, with the visibility as the
// last row. The tile appears twice each way, so that a seam would show. The ground is grey.
bake::Picture raw_sheet(const bake::material::RawMaterial& raw);

// For a view near the normal and a tilted one: draws raw, decoded, and the absolute difference three times
// (the seed's Figure 3). Below, it draws the visibility of both and where it differs.
bake::Picture difference_sheet(const bake::material::RawMaterial& raw,
                               const nook::material::Material& material);

// Draws materials that were compressed from one raw material, in columns beside it. The view is tilted by 55
// degrees, the light by 45. Below is the absolute difference three times (the seed's Figure 3).
bake::Picture methods_sheet(const bake::material::RawMaterial& raw,
                            std::span<const nook::material::Material> materials);

// Draws a step of the view of view_errors.h: the material before and after it, and the absolute difference
// ten times. The light is tilted by 45 degrees, and there are two tiles each way.
bake::Picture jump_strip(const nook::material::Material& material, const bake::material::ViewJumps& jumps);

bake::Picture below_each_other(std::span<const bake::Picture> pictures);

}  // namespace nook::measure
