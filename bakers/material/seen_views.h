// A compressed material in views and under lights that were not fitted.
#pragma once

#include <vector>

#include "sdk/src/material/material.h"

namespace nook::bake::material {

// Returns the material with other views in place of its own. Each view has the clusters and coefficients that
// decoding uses for its direction: the cell of the view map, or the mix of the three nearest views in it. The
// result has no view maps.
nook::material::Material as_seen_from(const nook::material::Material& material,
                                      const std::vector<Vec3>& views);

// Replaces the light basis by a basis for other lights. Each is mixed from the material's three nearest
// lights, as in decoding.
void light_from(nook::material::Material& material, const std::vector<Vec3>& lights);

}  // namespace nook::bake::material
