// The reference of specular occlusion: which share of a glossy reflection of uniform light reaches the
// viewer.
#pragma once

#include <cstdint>
#include <span>

#include "bakers/raytrace/environment.h"
#include "bakers/raytrace/ray_scene.h"

namespace nook::bake {

// A point in world space. Directions have unit length, and dot(normal, to_viewer) is above 0.
struct GlossyPoint {
  Vec3 position, normal, to_viewer;
  float radius = 1;         // metres; hits beyond it count as open
  float origin_offset = 0;  // metres along the normal
};

// Returns the mean visibility over the directions that a GGX surface without Fresnel's term reflects to the
// viewer, weighted by its radiance of uniform light. roughness is perceptual, in (0, 1]: the GGX width is its
// square. Directions come from the visible normals (E. Heitz, Sampling the GGX Distribution of Visible
// Normals, 2018). Their weight is the masking on the light's side given the viewer's side, G2 / G1. The same
// seed gives the same result. Needs FlushDenormals on the calling thread.
float trace_specular_visibility(const RayScene& scene, const GlossyPoint& point, float roughness,
                                std::uint32_t rays, std::uint64_t seed);

inline constexpr std::size_t max_glossy_maps = 8;

// The same reflection under maps: the mean radiance that the viewer sees, and the radiance without occlusion.
struct GlossyLight {
  float visible = 1;  // trace_specular_visibility
  Vec3 seen[max_glossy_maps], open[max_glossy_maps];
};

// There are at most max_glossy_maps maps. Needs FlushDenormals on the calling thread.
GlossyLight trace_glossy_light(const RayScene& scene, const GlossyPoint& point, float roughness,
                               std::uint32_t rays, std::uint64_t seed, std::span<const Environment> maps);

}  // namespace nook::bake
