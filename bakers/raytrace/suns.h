// The suns of an environment: sources so small and bright that a host draws them as lights of their own, with
// shadows.
#pragma once

#include <vector>

#include "bakers/raytrace/environment.h"

namespace nook::bake {

// Texels are sun where their luminance is above this many times the mean of the environment without its suns.
inline constexpr double sun_ratio = 100;

// The luminance where suns begin: sun_ratio times the mean of what lies below it.
float sun_limit(const Environment& environment);

// The sky's share of a texel: its colour at a luminance of the limit or less.
inline Vec3 without_sun(Vec3 radiance, float limit) {
  const float bright = luminance(radiance);
  return bright > limit ? radiance * (limit / bright) : radiance;
}
Environment without_suns(const Environment& environment);

// Texels above the limit that touch each other.
struct Sun {
  Vec3 direction;      // unit, towards the middle of its light
  Vec3 irradiance;     // RGB on a surface that faces it, of its light above the limit
  double solid_angle;  // steradians
};
// The brightest ones, by luminance.
std::vector<Sun> find_suns(const Environment& environment, std::size_t max_count);

}  // namespace nook::bake
