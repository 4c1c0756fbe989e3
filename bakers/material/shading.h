// The light that a point of a meso-surface sends to a viewer, for many light directions at once. Radiance for
// a light of irradiance 1 on a plane facing it: a white diffuse plane lit from above gives 1 / pi.
#pragma once

#include <span>
#include <vector>

#include "bakers/material/tiled_scene.h"

namespace nook::bake::material {

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

// Light of the meso-surface on itself: for each vertex and light the irradiance after up to `bounces` diffuse
// reflections, RGB, vertex-major. `rays` cosine-weighted rays leave each vertex; the same seed gives the same
// bits on any number of threads.
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

// value[3 l + channel] of one hit, seen along `view`.
void shade(const MesoSurface& surface, const TiledScene& scene, const InterReflection& indirect,
           const SurfaceHit& hit, Vec3 view, std::span<const Vec3> lights, std::span<float> value,
           LightScratch& scratch);

}  // namespace nook::bake::material
