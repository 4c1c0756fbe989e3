// The suns of an environment, by the rule of the runtime: sdk/src/core/map_suns.h.
#pragma once

#include <vector>

#include "bakers/raytrace/environment.h"
#include "sdk/src/core/light_map.h"

namespace nook::bake {

using Sun = MapSun;

// The luminance where suns begin.
double sun_limit(const Environment& environment);
// Without the brightest ones, at most so many.
Environment without_suns(const Environment& environment, std::size_t max_count = ~std::size_t(0));
// The brightest ones, by luminance.
std::vector<Sun> find_suns(const Environment& environment, std::size_t max_count);

}  // namespace nook::bake
