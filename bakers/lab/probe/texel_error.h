// Measures fits to a map in the way of Probulator, so that its published errors can be compared.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "bakers/raytrace/environment.h"

namespace nook::lab {

// Returns a row for each method of probe_methods that takes samples one after the other. Probulator fits to
// 20,000 Halton samples, with the lobes in its own axes. `irradiance_rms` and `radiance_rms` are over
// channels and over all texels with the same weight, so the poles count more than by solid angle. Irradiance
// is divided by pi and computed by the fitted curve. Normals are at (column + 0.5) / (width - 1) and (row +
// 0.5) / (height - 1), and so is the light of a texel. `irradiance_rms_area` has normals weighted by solid
// angle. The map is not resized; Probulator uses 256 x 128 texels.
nlohmann::ordered_json texel_rows(const bake::Environment& map, const std::string& map_name,
                                  std::uint32_t lobes);

}  // namespace nook::lab
