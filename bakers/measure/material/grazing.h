// Sharpness of a material in grazing views, whose pixels are longer along the tilt of the view.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/material/raw_material.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

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

}  // namespace nook::bake::material
