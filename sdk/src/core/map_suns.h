// The suns of a map: sources so small and bright that a host draws them as lights of their own, with shadow
// maps, while lobes or probes hold the rest.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/light_map.h"

namespace nook {

// Texels are sun where their luminance is above this many times the mean of the map without its suns.
inline constexpr double sun_ratio = 100;

struct MapSun {
  Vec3 direction;         // unit, towards the middle of its light
  Vec3 irradiance;        // RGB on a surface that faces it, of its light above the limit
  float solid_angle = 0;  // of its texels, steradians
  // Of the even disc that stands for it, steradians: the disc has the sun's irradiance and the integral of
  // its squared luminance. Texels of glare, which are many and hold little light, hardly count.
  float disc_solid_angle = 0;
};

// Returns the luminance where suns begin: sun_ratio times the mean of what lies below it.
double sun_limit(const MapView& map, Memory* memory);

// Returns the sky's share of a texel: its colour at a luminance of the limit or less.
Vec3 without_sun(Vec3 rgb, double limit);

// Takes the brightest suns, at most so many, out of `rgb`, a copy of the texels of `map`: their texels keep
// their colour at the luminance of the limit. Suns are groups of touching texels above the limit. Returns
// those that were taken, the brightest first.
Vector<MapSun> take_suns(const MapView& map, Vector<float>& rgb, Memory* memory,
                         std::size_t most = ~std::size_t(0));

}  // namespace nook
