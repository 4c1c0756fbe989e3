// Physically based materials: the reflection, the maps, and the surface that the maps describe.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/material/meso_surface.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// The reflection of a rough dielectric or metal, as files of physically based materials define it. It is GGX
// and Schlick's Fresnel term over a Lambertian part (glTF 2.0 specification, appendix B). As in engines,
// Smith's masking is correlated by height (E. Heitz, Understanding the Masking-Shadowing Function, JCGT
// 2014).

inline constexpr float dielectric_reflectance = 0.04f;  // at normal incidence
// Smoother surfaces get this roughness. Otherwise, their highlights would fall between the sampled
// directions.
inline constexpr float least_roughness = 0.1f;

// Returns the GGX width for a perceptual roughness from 0 to 1. The width is the square of the roughness.
// Roughness below least_roughness is raised to least_roughness.
float ggx_width(float roughness);

struct Reflector {
  Vec3 diffuse;      // linear RGB; lower for metals
  Vec3 reflectance;  // at normal incidence, linear RGB
  float width = 1;   // GGX width
};

// Returns pi times the BRDF, so that a white Lambertian surface gives 1. Pass unit vectors that point away
// from the surface. The light must be above the surface. A view lower than 3 degrees above the surface is
// raised to 3 degrees.
Vec3 microfacet_reflection(const Reflector& surface, Vec3 normal, Vec3 view, Vec3 light);

// The slopes of a surface around a point, dz / dx and dz / dy, and the mean of the variances of both.
struct MapSlope {
  float x = 0, y = 0, variance = 0;
};

// Values at a grid of points of the tile. Value y * side + x is at ((x + 0.5) / side, (y + 0.5) / side). The
// tile repeats. Only the base colour is required.
struct PbrMaps {
  std::uint32_t side = 0;
  std::vector<Vec3> base_colour;     // linear RGB
  std::vector<float> height;         // in units of a height scale; empty: flat
  std::vector<MapSlope> slope;       // from a normal map; empty: slopes come from the heights
  std::vector<float> squared_width;  // mean square of the GGX width; empty: 1, which is matte
  std::vector<float> metalness;      // 0 to 1; empty: 0
};

// Returns the heights of a map in tiles: values * height_scale_m / side_m, shifted so that the middle of
// their range is 0. Returns an empty array for a flat map. Throws what surface_of_maps() throws.
std::vector<float> heights_of_map(const PbrMaps& maps, float height_scale_m, float side_m);

// Returns maps with only the heights, resampled to side x side points by TileFilter.
PbrMaps heights_at(const PbrMaps& maps, std::uint32_t side);

// Makes the displaced surface. The heights are as in heights_of_map(). Shading normals come from the slopes.
// If slopes vary around a point, its highlight becomes wider: twice their variance is added to the squared
// GGX width (M. Olano, D. Baker, LEAN Mapping, I3D 2010). A metal has no diffuse part. Its reflectance is the
// base colour. Throws Failure(INVALID_ARGUMENT) if the height scale is negative, the side is not above 0, or
// the surface is higher than half a tile.
MesoSurface surface_of_maps(const PbrMaps& maps, float height_scale_m, float side_m);

}  // namespace nook::bake::material
