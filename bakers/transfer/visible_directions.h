// The directions in which a point sees the sky, out of a fixed set of directions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "bakers/transfer/surface_holes.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/transfer/distant_light.h"

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

// The lobes that reach each of a fixed set of directions.

// The lobes that hold light from each direction, with their value times the direction's solid angle.
struct LobesOfDirections {
  std::vector<std::uint32_t> begin;  // of each direction, and one past the end
  std::vector<std::uint32_t> lobe;
  std::vector<float> weight;
  float integral = 0;  // of one lobe
};

LobesOfDirections lobes_of(const nook::transfer::CubeCells& cells, std::uint32_t lobes);

}  // namespace nook::bake::transfer
