// The suns of a map: sources so small and bright that a host draws them as lights of their own, with shadow
// maps, while lobes hold the rest. bakers/raytrace/suns.h has the same rule for latitude-longitude maps.
#pragma once

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/transfer/light_cube.h"

namespace nook::transfer {

// Texels are sun where their luminance is above this many times the mean of the map without its suns.
inline constexpr double sun_ratio = 100;

struct MapSun {
  Vec3 direction;         // unit, towards the middle of its light
  Vec3 irradiance;        // RGB on a surface that faces it, of its light above the limit
  float solid_angle = 0;  // steradians
};

// Takes the suns out of `rgb`, a copy of the texels of `map`: texels above the limit keep their colour at
// the luminance of the limit. Returns groups of touching texels, the brightest first.
Vector<MapSun> take_suns(const MapView& map, Vector<float>& rgb, Memory* memory);

}  // namespace nook::transfer
