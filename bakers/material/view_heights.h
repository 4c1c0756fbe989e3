// Heights of a raw material's relief, from what its views agree on.
#pragma once

#include <vector>

#include "bakers/material/raw_material.h"

namespace nook::bake::material {

// Returns heights over the plane z = 0 in tiles, one for each texel. The views within 53 degrees of the
// normal show the most similar colours there, in 3 x 3 texels. 49 heights up to 0.24 tiles on either side are
// tried, and a parabola places the result between them.
std::vector<float> heights_of_views(const RawMaterial& raw);

}  // namespace nook::bake::material
