// Rays through the holes of the meso-structure that a mesh wears.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/import/surface_mesh.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/material/tables.h"
#include "sdk/src/transfer/tangent_frame.h"

namespace nook::bake::transfer {

// The share of a material's meso-structure that a straight line meets, tabulated from its VOTF. Millions of
// rays can look it up at any size of footprint.

struct HoleTable {
  std::uint64_t votf_hash = 0;  // hash of the material's VOTF
  std::uint32_t side = 0;       // cells of the parabolic map of views
  std::uint32_t width = 0, height = 0, levels = 0;
  // For each cell, one level after another, rows of texels: 255 where a line meets the structure, 0 in a
  // hole. Levels are means of the finest one. Levels of signed distances would not be.
  std::vector<std::uint8_t> cover;

  std::size_t cell_bytes() const;
  // Returns the share that lines along `view` meet around a point of the tile, which repeats. view is a unit
  // vector of tangent space with z >= 0; level is log2 of the footprint's side in texels.
  float cover_at(float u, float v, float level, Vec3 view) const;
};

// Throws Failure(INVALID_ARGUMENT) if the material has no VOTF.
HoleTable make_hole_table(const nook::material::MaterialTables& tables);

// Returns the frame of a point of a triangle, interpolated from its vertices.
nook::transfer::Frame frame_at(const SurfaceMesh& mesh, const RayHit& hit);

class SurfaceHoles {
 public:
  // The material has `tiles` tiles in one unit of texture coordinates. Each ray represents the light within
  // spread_rad of it. Both references must outlive this object.
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

// Calls body(hit, share) for the surfaces along a ray, the nearest first, with the share of the ray that ends
// there. Returns the share that reaches the sky. holes may be null: then the first surface takes all.
template <class Body>
float walk_surfaces(const RayScene& scene, const SurfaceHoles* holes, Vec3 origin, Vec3 direction,
                    Body&& body) {
  // A remainder of the ray below half a step of a byte does not count.
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
