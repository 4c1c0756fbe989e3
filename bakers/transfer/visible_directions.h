// Finds the directions of a fixed set in which a point sees the sky.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "bakers/transfer/surface_holes.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/transfer/distant_light.h"

namespace nook::bake::transfer {

// A direction's index, and the share of its light that arrives. Holes can make the share less than 1.
struct VisibleDirection {
  std::uint32_t direction = 0;
  float share = 1;
};

// Appends to `visible` the directions above the horizon of `normal` from which light arrives. Within a packet
// of 16 rays, indices are ascending. Both sides of triangles occlude. `holes` may be null. The calling thread
// must have a FlushDenormals object.
void visible_directions(const RayScene& scene, Vec3 origin, Vec3 normal, std::span<const Vec3> directions,
                        const SurfaceHoles* holes, std::vector<VisibleDirection>& visible);

// Finds the lobes that reach each of a fixed set of directions.

// For each direction, the lobes that send light from it. The weight is the lobe's value times the direction's
// solid angle.
struct LobesOfDirections {
  std::vector<std::uint32_t> begin;  // per direction, and one past the end
  std::vector<std::uint32_t> lobe;
  std::vector<float> weight;
  float integral = 0;  // integral of one lobe
};

LobesOfDirections lobes_of(const nook::transfer::CubeCells& cells, std::uint32_t lobes);

}  // namespace nook::bake::transfer
