// Errors of a material in views that were not fitted: unseen views and lights, grazing views, and a slowly
// moving view.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/material/seen_views.h"
#include "sdk/src/material/material.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

struct UnseenError {
  double se_db = 0;
  std::optional<std::size_t> error_texels;  // texels of the VOTF, in the material's form
};
// Compares with raw data that has other views or other lights, and the same texels. Throws
// Failure(INVALID_ARGUMENT) if the texels differ.
UnseenError measure_unseen(const RawMaterial& unseen, const nook::material::Material& material);

// Mean squares over pixels, lights and views. The first compares drawn radiances with the mean of the file
// over each pixel, which is the error of the filter alone. The second compares them with the mean of the raw
// images, which includes the error of the compression.
struct GrazingError {
  std::uint32_t fetches = 1;  // per mode; 1 is isotropic filtering, at the mipmap level of the longer side
  double mse = 0, mse_raw = 0;
};

// Measures the raw material's views between 60 and 85 degrees, with 1, 2, 3, 4 and 8 fetches. A pixel is as
// wide as a texel across the tilt and 1 / cos(tilt) texels along it, and 32 places on the tile are measured
// for each view. The truth is the mean over at least 8 x 8 samples per texel of the pixel, with bilinear
// filtering at the finest level. Returns an empty list if there are no such views. Throws
// Failure(INVALID_ARGUMENT) if the texels differ from the raw material's.
std::vector<GrazingError> measure_grazing(const RawMaterial& raw,
                                          const nook::material::MaterialTables& tables);

inline constexpr float jump_step_deg = 0.1f;

struct ViewJumps {
  // How much the radiances of all lights change in one step of the view: the largest step, and the 99th
  // percentile of all steps. Each change is the root mean square over texels, relative to the radiances.
  double largest = 0, percentile_99 = 0;
  Vec3 before, after;  // the views of the largest step
};

// Moves the view along 64 random arcs of 6 degrees, at most 70 degrees from the normal. Decodes like the
// runtime, on a grid of up to 16 x 16 texels.
ViewJumps measure_view_jumps(const nook::material::Material& material, std::uint64_t seed);

}  // namespace nook::bake::material
