// The directions in which a point sees the sky, out of a fixed set of directions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::transfer {

// Appends to `visible` the indices of the directions above the horizon of `normal` in which no triangle lies;
// both sides of triangles occlude. The caller has set FlushDenormals.
void visible_directions(const RayScene& scene, Vec3 origin, Vec3 normal, std::span<const Vec3> directions,
                        std::vector<std::uint32_t>& visible);

}  // namespace nook::bake::transfer
