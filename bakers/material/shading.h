// Computes the radiance from a point of a meso-surface to a viewer, for many light directions at once. Each
// light has irradiance 1 on a plane that faces it, so a white diffuse plane lit from above gives 1 / pi.
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
  Vec3 normal;         // geometric normal, unit length, out of the solid
};

// A BVH with as many copies of one tile as a ray of the largest tilt can cross. You can trace from any
// thread, if the thread has created a FlushDenormals object that still exists.
class TiledScene {
 public:
  // The surface must outlive the scene.
  explicit TiledScene(const MesoSurface& surface);

  float top() const { return top_; }
  float bottom() const { return bottom_; }

  SurfaceHit nearest(Vec3 origin, Vec3 direction) const;
  // Sets open[i] to true if a ray from just above the hit along directions[i] meets nothing.
  void open_directions(const SurfaceHit& from, std::span<const Vec3> directions,
                       std::span<unsigned char> open) const;
  // Returns a point just outside the solid, moved by whole tiles into the middle tile.
  Vec3 outside(Vec3 position, Vec3 normal) const;

 private:
  const MesoSurface& surface_;
  float top_, bottom_;
  RayScene tile_, plane_;
};

// Interpolates a vertex attribute at a hit.
template <class T>
T at_hit(std::span<const T> vertex_value, std::span<const std::array<std::uint32_t, 3>> triangles,
         const SurfaceHit& hit) {
  const auto& t = triangles[hit.triangle];
  return vertex_value[t[0]] * (1 - hit.u - hit.v) + vertex_value[t[1]] * hit.u + vertex_value[t[2]] * hit.v;
}

// Working memory for the calls below. Reuse it between calls.
struct LightScratch {
  std::vector<Vec3> towards;
  std::vector<std::uint32_t> index;
  std::vector<unsigned char> open;
  std::vector<float> cosine;
};

// Computes the cosines of all lights at a hit. A cosine is zero if the light is blocked or behind the
// surface.
void direct_cosines(const TiledScene& scene, const SurfaceHit& hit, Vec3 shading_normal,
                    std::span<const Vec3> lights, std::span<float> cosine, LightScratch& scratch);

// The light that the meso-surface reflects onto itself. It stores the RGB irradiance after up to `bounces`
// diffuse reflections for each vertex and light, vertex-major. `rays` cosine-weighted rays are traced from
// each vertex. The same seed gives the same bits on any number of threads.
class InterReflection {
 public:
  InterReflection(const MesoSurface& surface, const TiledScene& scene, std::span<const Vec3> lights,
                  std::uint32_t rays, std::uint32_t bounces, std::uint64_t seed);

  // Adds albedo x irradiance at a hit to value[3 l + channel].
  void add(const SurfaceHit& hit, Vec3 albedo, std::span<float> value) const;

 private:
  const MesoSurface& surface_;
  std::size_t lights_;
  std::vector<float> irradiance_;  // empty if there are no bounces
};

// Sets value[3 l + channel], for each light l, at one hit that is seen along `view`.
void shade(const MesoSurface& surface, const TiledScene& scene, const InterReflection& indirect,
           const SurfaceHit& hit, Vec3 view, std::span<const Vec3> lights, std::span<float> value,
           LightScratch& scratch);

}  // namespace nook::bake::material
