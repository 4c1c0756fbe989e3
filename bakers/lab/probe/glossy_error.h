// Measures the glossy reflection of a probe that is fitted to a map. Random GGX surfaces reflect the probe's
// lobes and the map itself, and the reference is computed by numerical integration. Prefiltered cube maps of
// the lobes and of the map are measured as well.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/environment.h"

namespace nook::lab {

struct GlossySettings {
  std::uint32_t lobes = 12;
  std::uint32_t surfaces = 512;  // number of random surfaces of each kind
  std::uint64_t seed = 1;
};

// Returns a row for each kind of surface and each form. The error of a surface is the root mean square over
// channels of the difference in radiance, divided by the mean radiance of the map. `rms`, `percentile_95` and
// `worst` are statistics of this error over the surfaces, relative to the exact reflection of the lobes.
// `map_rms` is relative to the exact reflection of the map, after the map was reduced to 128 columns. There
// are two kinds of surfaces. The first kind has one GGX width, a roughness from 0.1 to 1, and a reflectance
// of 1 or 0.04. The second kind has two different widths in the same range, with ratios up to 1 : 36, and is
// seen at grazing angles.
nlohmann::ordered_json glossy_rows(const bake::Environment& map, const std::string& map_name,
                                   const GlossySettings& settings, const bake::Progress& progress);

}  // namespace nook::lab
