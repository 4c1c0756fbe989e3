// Errors of a material in other views than the fitted ones: unseen views and lights, grazing views, and a
// view that moves slowly.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/material/raw_material.h"
#include "sdk/src/material/material.h"
#include "sdk/src/material/tables.h"

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

// Mean squares of radiances over pixels, lights and views: of the drawn ones less the mean of the file, or
// of the raw images, over each pixel. The first has the error of the filter alone, the second that of the
// compression too.
struct GrazingError {
  std::uint32_t fetches = 1;  // of each mode; 1 is isotropic, at the level of the longer side
  double mse = 0, mse_raw = 0;
};

// Of the raw material's views between 60 and 85 degrees, with 1, 2, 3 and 4 fetches, and 8. A pixel is as
// wide as a texel across the tilt and 1 / cos(tilt) texels along it, at 32 places of the tile for each view;
// the means are over 8 x 8 samples or more for each texel of it, bilinear and of the finest level. Empty
// where there is no such view. Throws Failure(INVALID_ARGUMENT) where texels are not the raw material's.
std::vector<GrazingError> measure_grazing(const RawMaterial& raw,
                                          const nook::material::MaterialTables& tables);

inline constexpr float jump_step_deg = 0.1f;

struct ViewJumps {
  // The change of the radiances of all lights over a step of the view, as the root of the mean square over
  // texels, relative to the radiances themselves: the largest of all steps, and the 99th percentile.
  double largest = 0, percentile_99 = 0;
  Vec3 before, after;  // the views of the largest
};

// Moves the view along 64 random arcs of 6 degrees, no more than 70 degrees from the normal, and decodes as
// the runtime does, on a grid of up to 16 x 16 texels.
ViewJumps measure_view_jumps(const nook::material::Material& material, std::uint64_t seed);

}  // namespace nook::bake::material
