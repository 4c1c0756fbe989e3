// The reference for specular occlusion: the share of a glossy reflection of uniform light that reaches the
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
  float radius = 1;         // metres; hits beyond this distance count as open
  float origin_offset = 0;  // metres along the normal
};

// Returns the mean visibility over the directions that a GGX surface without the Fresnel term reflects to the
// viewer. Directions are weighted by the radiance that they contribute under uniform light. `roughness` is
// perceptual, in (0, 1]; its square is the width of GGX. Directions come from the visible normals (E. Heitz,
// Sampling the GGX Distribution of Visible Normals, 2018). The weight of a direction is G2 / G1: the masking
// of the light, given the masking of the view. The same seed gives the same result. The calling thread must
// have a FlushDenormals object.
float trace_specular_visibility(const RayScene& scene, const GlossyPoint& point, float roughness,
                                std::uint32_t rays, std::uint64_t seed);

inline constexpr std::size_t max_glossy_maps = 8;

// The same reflection under environment maps: the mean radiance that the viewer sees, with occlusion (seen)
// and without (open).
struct GlossyLight {
  float visible = 1;  // trace_specular_visibility
  Vec3 seen[max_glossy_maps], open[max_glossy_maps];
};

// Pass at most max_glossy_maps maps. The calling thread must have a FlushDenormals object.
GlossyLight trace_glossy_light(const RayScene& scene, const GlossyPoint& point, float roughness,
                               std::uint32_t rays, std::uint64_t seed, std::span<const Environment> maps);

}  // namespace nook::bake
