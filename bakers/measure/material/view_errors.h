// Measures errors of a material outside the fitted views: in unseen views and under unseen lights, in grazing
// views, and while the view moves slowly.
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
  // Number of wrong texels of the VOTF, in the form that the material uses.
  std::optional<std::size_t> error_texels;
};
// Compares the material with raw data that has the same texels but other views or other lights. Throws
// Failure(INVALID_ARGUMENT) if the texels differ.
UnseenError measure_unseen(const RawMaterial& unseen, const nook::material::Material& material);

// Mean squared errors over pixels, lights and views. `mse` compares the drawn radiances with the decoded
// file, averaged over each pixel. It is the error of the texture filter alone. `mse_raw` compares them with
// the raw images, averaged over each pixel. It also includes the error of the compression.
struct GrazingError {
  std::uint32_t fetches = 1;  // texture fetches per mode; 1 is isotropic filtering, at the mipmap level of
                              // the pixel's longer side
  double mse = 0, mse_raw = 0;
};

// Measures the views of the raw material that are tilted by 60 to 85 degrees, with 1, 2, 3, 4 and 8 fetches.
// A pixel is one texel wide across the tilt direction, and 1 / cos(tilt) texels long along it. 32 pixels on
// the tile are measured for each view. The reference of a pixel is a mean over at least 8 x 8 samples per
// texel, with bilinear filtering at the finest level. Returns an empty list if the raw material has no such
// views. Throws Failure(INVALID_ARGUMENT) if the texels differ from the raw material's.
std::vector<GrazingError> measure_grazing(const RawMaterial& raw,
                                          const nook::material::MaterialTables& tables);

inline constexpr float jump_step_deg = 0.1f;

struct ViewJumps {
  // The change of the radiances under all lights in one step of the view: the largest change, and the 99th
  // percentile over all steps. A change is a root mean square over texels, relative to the radiances.
  double largest = 0, percentile_99 = 0;
  Vec3 before, after;  // the views before and after the step with the largest change
};

// Moves the view along 64 random arcs. Each arc is 6 degrees long and at most 70 degrees from the normal.
// Decodes the material in the same way as the runtime, on a grid of up to 16 x 16 texels.
ViewJumps measure_view_jumps(const nook::material::Material& material, std::uint64_t seed);

}  // namespace nook::bake::material
