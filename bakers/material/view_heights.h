// Heights of a raw material's relief, from what its views agree on.
#pragma once

#include <vector>

#include "bakers/material/raw_material.h"

namespace nook::bake::material {

// Heights over the plane z = 0 in tiles, one for each texel: those at which views within 53 degrees of the
// normal differ least over 3 x 3 texels, of 49 levels to 0.24 tiles on either side and placed between them.
std::vector<float> heights_of_views(const RawMaterial& raw);

}  // namespace nook::bake::material
