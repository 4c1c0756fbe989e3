// A compressed material in views, and under lights, that it was not fitted to.
#pragma once

#include <optional>

#include "bakers/material/raw_material.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

// The material with other views in the place of its own, each with the clusters and coefficients that
// decoding takes for that direction: the cell of the view map, or the mix of the three nearest views in it.
// Has no view maps.
nook::material::Material as_seen_from(const nook::material::Material& material,
                                      const std::vector<Vec3>& views);

// Replaces the light basis by that of other lights, each mixed from the three nearest of the material's as
// decoding does.
void light_from(nook::material::Material& material, const std::vector<Vec3>& lights);

struct UnseenError {
  double se_db = 0;
  std::optional<std::size_t> error_texels;  // of the VOTF, in the form that the material has
};
// Against raw data of other views, and other lights where they differ, but of the material's texels: throws
// Failure(INVALID_ARGUMENT) where these differ.
UnseenError measure_unseen(const RawMaterial& unseen, const nook::material::Material& material);

}  // namespace nook::bake::material
