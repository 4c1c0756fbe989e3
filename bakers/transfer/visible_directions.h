// The directions in which a point sees the sky, out of a fixed set of directions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "bakers/transfer/surface_holes.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::transfer {

// A direction by its index, and the share of its light that arrives: below 1 only through holes.
struct VisibleDirection {
  std::uint32_t direction = 0;
  float share = 1;
};

// Appends to `visible` the directions above the horizon of `normal` from which light arrives, by rising index
// within a packet of 16 rays; both sides of triangles occlude. holes may be null. The caller has set
// FlushDenormals.
void visible_directions(const RayScene& scene, Vec3 origin, Vec3 normal, std::span<const Vec3> directions,
                        const SurfaceHoles* holes, std::vector<VisibleDirection>& visible);

}  // namespace nook::bake::transfer
