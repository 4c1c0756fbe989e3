// Compares the glossy reflection of a map's probe with quadrature. Random GGX surfaces reflect the probe's
// own lobes and the map, beside prefiltered cube maps of both.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/environment.h"

namespace nook::lab {

struct GlossySettings {
  std::uint32_t lobes = 12;
  std::uint32_t surfaces = 512;  // random surfaces of each kind
  std::uint64_t seed = 1;
};

// Returns a row for each kind of surface and each form. rms, percentile_95 and worst are over surfaces: the
// root mean square over channels of the difference in radiance, over the mean radiance of the map. Truth is
// what the surface reflects of the lobes. For map_rms, it is what the surface reflects of the map, which is
// reduced to 128 columns. Kinds: one width, roughness 0.1 to 1, reflectance 1 and 0.04; two widths, both in
// that range and up to 1 : 36, at grazing views.
nlohmann::ordered_json glossy_rows(const bake::Environment& map, const std::string& map_name,
                                   const GlossySettings& settings, const bake::Progress& progress);

}  // namespace nook::lab
