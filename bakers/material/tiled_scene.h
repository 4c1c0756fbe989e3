// A meso-surface repeated over the plane, for rays.
#pragma once

#include <span>
#include <vector>

#include "bakers/material/meso_surface.h"
#include "bakers/raytrace/ray_scene.h"

namespace nook::bake::material {

struct SurfaceHit {
  static constexpr std::uint32_t nothing = ~0u;
  std::uint32_t triangle = nothing;
  float u = 0, v = 0;  // barycentric weights of the second and third vertex
  Vec3 position;       // tile space
  Vec3 normal;         // geometric, unit, out of the solid
};

// The BVH of one tile, in as many copies as a ray of the largest tilt can cross; any thread may trace.
// Callers flush denormals (FlushDenormals).
class TiledScene {
 public:
  // The surface must outlive the scene.
  explicit TiledScene(const MesoSurface& surface);

  float top() const { return top_; }
  float bottom() const { return bottom_; }

  SurfaceHit nearest(Vec3 origin, Vec3 direction) const;
  // Sets open[i] where nothing lies along directions[i] from just above a hit.
  void open_directions(const SurfaceHit& from, std::span<const Vec3> directions,
                       std::span<unsigned char> open) const;
  // A point just outside of the solid, moved by whole tiles into the middle one.
  Vec3 outside(Vec3 position, Vec3 normal) const;

 private:
  const MesoSurface& surface_;
  float top_, bottom_;
  RayScene tile_, plane_;
};

// A vertex attribute at a hit.
template <class T>
T at_hit(std::span<const T> vertex_value, std::span<const std::array<std::uint32_t, 3>> triangles,
         const SurfaceHit& hit) {
  const auto& t = triangles[hit.triangle];
  return vertex_value[t[0]] * (1 - hit.u - hit.v) + vertex_value[t[1]] * hit.u + vertex_value[t[2]] * hit.v;
}

}  // namespace nook::bake::material
