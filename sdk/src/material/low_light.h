// Light that is lower than all sampled lights.
#pragma once

#include <algorithm>
#include <span>

#include "sdk/src/material/direction_mesh.h"

namespace nook::material {

// Returns the ratio of the cosine of a light beyond the outermost sampled lights to that of the nearest
// direction between them, `mix`, so that light fades to 0 at the horizon. It is 1 between the samples.
inline float low_light_share(std::span<const Vec3> lights, const DirectionMix& mix, float z) {
  ParabolicPoint nearest{};
  for (int i = 0; i < 3; ++i) {
    const ParabolicPoint p = to_parabolic(lights[mix.index[i]]);
    nearest.x += mix.weight[i] * p.x;
    nearest.y += mix.weight[i] * p.y;
  }
  const float cosine = from_parabolic(nearest).z;
  // Between the samples both cosines are equal up to rounding.
  return z < cosine - 1e-5f ? std::max(z, 0.0f) / cosine : 1.0f;
}

}  // namespace nook::material
