// Converts a compressed material to views and lights that were not fitted.
#pragma once

#include <vector>

#include "sdk/src/material/material.h"

namespace nook::bake::material {

// Returns the material with other views instead of its own. Each view gets the clusters and coefficients that
// decoding uses for its direction. They come from the cell of the view map, or from the mix of the three
// nearest views. The result has no view maps.
nook::material::Material as_seen_from(const nook::material::Material& material,
                                      const std::vector<Vec3>& views);

// Replaces the light basis by a basis for other lights. Each light is interpolated from the material's three
// nearest lights, as in decoding.
void light_from(nook::material::Material& material, const std::vector<Vec3>& lights);

}  // namespace nook::bake::material
