// Rays through the holes of the meso-structure that a mesh wears.
#pragma once

#include <cstddef>
#include <optional>

#include "bakers/import/surface_mesh.h"
#include "bakers/raytrace/ray_scene.h"
#include "bakers/transfer/hole_table.h"
#include "sdk/src/transfer/tangent_frame.h"

namespace nook::bake::transfer {

// Returns the frame of a point of a triangle from those of its vertices.
nook::transfer::Frame frame_at(const SurfaceMesh& mesh, const RayHit& hit);

class SurfaceHoles {
 public:
  // The material has `tiles` tiles in one unit of texture coordinates. Rays stand for the light within
  // spread_rad of them. Both references must outlive this object.
  SurfaceHoles(const SurfaceMesh& mesh, const HoleTable& table, float tiles, float spread_rad);

  // Returns the share of a ray that the surface at a hit stops. A line through the structure meets the same
  // share of it in both directions.
  float cover(const RayHit& hit, Vec3 direction) const;

  // Returns the share of light that comes through all surfaces along a ray.
  float share_through(const RayScene& scene, Vec3 origin, Vec3 direction) const;

 private:
  const SurfaceMesh& mesh_;
  const HoleTable& table_;
  float tiles_, spread_rad_;
};

// Returns the holes for rays that share the sphere evenly; none without a table.
std::optional<SurfaceHoles> surface_holes(const SurfaceMesh& mesh, const HoleTable* table, float tiles,
                                          std::size_t rays);

// Calls body(hit, share) for the surfaces along a ray from the nearest on, with the share of the ray that
// ends there, and returns the share that reaches the sky. holes may be null: the first surface takes all.
template <class Body>
float walk_surfaces(const RayScene& scene, const SurfaceHoles* holes, Vec3 origin, Vec3 direction,
                    Body&& body) {
  // The rest of a ray below half a step of a byte does not count.
  constexpr float nothing = 1 / 512.0f;
  float rest = 1, beyond = 0;
  while (rest > nothing) {
    const RayHit hit = scene.nearest(origin, direction, beyond);
    if (!(hit.distance < 1e30f)) return rest;
    const float cover = holes ? holes->cover(hit, direction) : 1.0f;
    if (cover > 0) body(hit, rest * cover);
    rest *= 1 - cover;
    beyond = hit.distance;
  }
  return 0;
}

}  // namespace nook::bake::transfer
