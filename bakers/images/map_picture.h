// Pictures of a map beside what a probe makes of it.
#pragma once

#include <span>

#include "bakers/images/picture.h"
#include "bakers/probe/map_light.h"

namespace nook::bake::probe {

// Four panels in a row, latitude-longitude, panel_width by half of it: the map; the probe's radiance; its
// irradiance over pi, as a white surface would look; and the luminance of its radiance error, e / (e + the
// map's mean luminance), from violet (0) over green to yellow (large). The colours of the first three have
// one exposure, by the map's mean luminance.
Picture map_picture(const Environment& map, const Basis& basis, std::span<const Vec3> coefficients,
                    std::uint32_t panel_width = 512);

}  // namespace nook::bake::probe
