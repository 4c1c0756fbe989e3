// The open share of a cone of directions, by rays.
#pragma once

#include <cstdint>

#include "bakers/raytrace/ray_scene.h"

namespace nook::bake {

struct RayCone {
  Vec3 axis;  // unit
  float half_angle_radians = 0;
};

// The rays are spread evenly over the cone's solid angle on a spiral, which `turn` in [0, 1) turns about the
// axis.
float open_cone_share(const RayScene& scene, Vec3 origin, const RayCone& cone, std::uint32_t rays,
                      float turn);

}  // namespace nook::bake
