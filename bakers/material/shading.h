// Computes the light that a point of a meso-surface sends to a viewer, for many light directions at once. The
// radiance is for a light with irradiance 1 on a plane that faces it: a white diffuse plane lit from above
// gives 1 / pi.
#pragma once

#include <span>
#include <vector>

#include "bakers/material/meso_surface.h"
#include "bakers/raytrace/ray_scene.h"

namespace nook::bake::material {

// A meso-surface repeated over the plane, for rays.

struct SurfaceHit {
  static constexpr std::uint32_t nothing = ~0u;
  std::uint32_t triangle = nothing;
  float u = 0, v = 0;  // barycentric weights of the second and third vertex
  Vec3 position;       // tile space
  Vec3 normal;         // geometric, unit, out of the solid
};

// The BVH of one tile, in as many copies as a ray of the largest tilt can cross. Any thread may trace.
// Callers flush denormals (FlushDenormals).
class TiledScene {
 public:
  // The surface must outlive the scene.
  explicit TiledScene(const MesoSurface& surface);

  float top() const { return top_; }
  float bottom() const { return bottom_; }

  SurfaceHit nearest(Vec3 origin, Vec3 direction) const;
  // Sets open[i] if nothing lies along directions[i] from just above a hit.
  void open_directions(const SurfaceHit& from, std::span<const Vec3> directions,
                       std::span<unsigned char> open) const;
  // Returns a point just outside of the solid, moved by whole tiles into the middle one.
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

// Working memory of the calls below, kept between them.
struct LightScratch {
  std::vector<Vec3> towards;
  std::vector<std::uint32_t> index;
  std::vector<unsigned char> open;
  std::vector<float> cosine;
};

// Cosines of all lights at a hit, zero where the light is blocked or behind the surface.
void direct_cosines(const TiledScene& scene, const SurfaceHit& hit, Vec3 shading_normal,
                    std::span<const Vec3> lights, std::span<float> cosine, LightScratch& scratch);

// The light that the meso-surface reflects onto itself. It has the irradiance after up to `bounces` diffuse
// reflections for each vertex and light, RGB, vertex-major. `rays` cosine-weighted rays leave each vertex.
// The same seed gives the same bits on any number of threads.
class InterReflection {
 public:
  InterReflection(const MesoSurface& surface, const TiledScene& scene, std::span<const Vec3> lights,
                  std::uint32_t rays, std::uint32_t bounces, std::uint64_t seed);

  // Adds albedo x irradiance at a hit to value[3 l + channel].
  void add(const SurfaceHit& hit, Vec3 albedo, std::span<float> value) const;

 private:
  const MesoSurface& surface_;
  std::size_t lights_;
  std::vector<float> irradiance_;  // empty without bounces
};

// Sets value[3 l + channel] for one hit, seen along `view`.
void shade(const MesoSurface& surface, const TiledScene& scene, const InterReflection& indirect,
           const SurfaceHit& hit, Vec3 view, std::span<const Vec3> lights, std::span<float> value,
           LightScratch& scratch);

}  // namespace nook::bake::material
