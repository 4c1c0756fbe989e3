// Measures fits to a map in the way of Probulator, so that its published errors can be compared.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "bakers/raytrace/environment.h"

namespace nook::lab {

// Returns a row for each method of probe_methods that takes samples one after the other. Probulator fits to
// 20,000 Halton samples, with the lobes in its own axes. `irradiance_rms` and `radiance_rms` are over
// channels and over all texels with the same weight, so the poles count too much. Irradiance is divided by pi
// and computed by the fitted curve. The normal of a texel is at (column + 0.5) / (width - 1) and
// (row + 0.5) / (height - 1). The light of a texel comes from this direction. `irradiance_rms_area` weights
// normals by solid angle. The map is not resized; Probulator uses 256 x 128 texels.
nlohmann::ordered_json texel_rows(const bake::Environment& map, const std::string& map_name,
                                  std::uint32_t lobes);

}  // namespace nook::lab
