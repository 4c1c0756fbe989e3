// Traces rays through the holes of the meso-structure on a mesh.
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

// A table of how much of a ray's footprint a material's meso-structure covers. It is made from the material's
// VOTF. Look-ups are fast enough for millions of rays with footprints of any size.

struct HoleTable {
  std::uint64_t votf_hash = 0;  // hash of the material's VOTF
  std::uint32_t side = 0;       // cells of the parabolic map of views
  std::uint32_t width = 0, height = 0, levels = 0;
  // The cells come one after another. Each cell contains its levels, and each level its rows of texels: 255
  // where a line meets the structure, 0 in a hole. Each level is a mean of the finest level. Levels of signed
  // distances would not give this mean.
  std::vector<std::uint8_t> cover;

  std::size_t cell_bytes() const;
  // Returns the share of lines along `view` that meet the structure around a point of the tile. The tile
  // repeats. `view` is a unit vector in tangent space with z >= 0. `level` is log2 of the footprint's side in
  // texels.
  float cover_at(float u, float v, float level, Vec3 view) const;
};

// Throws Failure(INVALID_ARGUMENT) if the material has no VOTF.
HoleTable make_hole_table(const nook::material::MaterialTables& tables);

// Returns the frame of a point on a triangle, interpolated from the triangle's vertices.
nook::transfer::Frame frame_at(const SurfaceMesh& mesh, const RayHit& hit);

class SurfaceHoles {
 public:
  // The material has `tiles` tiles in one unit of texture coordinates. Each ray represents the light within
  // spread_rad of its direction. `mesh` and `table` must outlive this object.
  SurfaceHoles(const SurfaceMesh& mesh, const HoleTable& table, float tiles, float spread_rad);

  // Returns the share of a ray that the surface at a hit stops. It is the same for both directions of a line
  // through the structure.
  float cover(const RayHit& hit, Vec3 direction) const;

  // Returns the share of light that passes all surfaces along a ray.
  float share_through(const RayScene& scene, Vec3 origin, Vec3 direction) const;

 private:
  const SurfaceMesh& mesh_;
  const HoleTable& table_;
  float tiles_, spread_rad_;
};

// Makes the holes for rays that are spread evenly over the sphere. Returns nothing if `table` is null.
std::optional<SurfaceHoles> surface_holes(const SurfaceMesh& mesh, const HoleTable* table, float tiles,
                                          std::size_t rays);

// Calls body(hit, share) for the surfaces along a ray, the nearest surface first. `share` is the share of the
// ray that this surface stops. Returns the share that reaches the sky. If `holes` is null, the first surface
// stops the whole ray.
template <class Body>
float walk_surfaces(const RayScene& scene, const SurfaceHoles* holes, Vec3 origin, Vec3 direction,
                    Body&& body) {
  // Stops when the rest of the ray is less than half a step of an 8-bit value.
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
