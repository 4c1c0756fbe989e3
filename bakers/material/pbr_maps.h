// Physically based materials: their reflection, their maps and the surface that the maps stand for.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/material/meso_surface.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// The reflection of a rough dielectric or metal as files of physically based materials mean it: GGX and
// Schlick's Fresnel term over a Lambertian part (glTF 2.0 specification, appendix B), with Smith's masking
// correlated by height (E. Heitz, Understanding the Masking-Shadowing Function, JCGT 2014), as engines have
// it.

inline constexpr float dielectric_reflectance = 0.04f;  // at normal incidence
// Smoother surfaces shine as this one: their highlights would fall between sampled directions.
inline constexpr float least_roughness = 0.1f;

// Returns the GGX width of a perceptual roughness of 0 to 1: its square, from least_roughness on.
float ggx_width(float roughness);

struct Reflector {
  Vec3 diffuse;      // linear RGB, already without the share of metal
  Vec3 reflectance;  // at normal incidence, linear RGB
  float width = 1;   // of GGX
};

// Returns pi times the BRDF, so that a white Lambertian surface gives 1. Unit vectors away from the surface,
// the light above it; a view below 3 degrees counts as one at 3 degrees.
Vec3 microfacet_reflection(const Reflector& surface, Vec3 normal, Vec3 view, Vec3 light);

// The maps of a physically based material, and the surface that they stand for.

// The slopes of a surface around a point: dz / dx and dz / dy, and the mean of their variances.
struct MapSlope {
  float x = 0, y = 0, variance = 0;
};

// Values at a grid of points of the tile, y * side + x at ((x + 0.5) / side, (y + 0.5) / side). The tile
// repeats. Only the base colour has to be there.
struct PbrMaps {
  std::uint32_t side = 0;
  std::vector<Vec3> base_colour;     // linear RGB
  std::vector<float> height;         // in units of a height scale; empty: flat
  std::vector<MapSlope> slope;       // of a normal map; empty: those of the heights
  std::vector<float> squared_width;  // the mean square of GGX's width; empty: 1, which is matte
  std::vector<float> metalness;      // 0 to 1; empty: 0
};

// Heights of a map in tiles, their middle at 0: values times height_scale_m over side_m. Empty: flat. Throws
// what surface_of_maps() throws.
std::vector<float> heights_of_map(const PbrMaps& maps, float height_scale_m, float side_m);

// The heights alone at side x side points, as TileFilter averages them.
PbrMaps heights_at(const PbrMaps& maps, std::uint32_t side);

// Makes the displaced surface: heights times height_scale_m over side_m are tiles, and the middle of the
// heights is z = 0. Normals for shading come from the slopes. Slopes that vary around a point widen its
// gloss: twice their variance is added to the squared width (M. Olano, D. Baker, LEAN Mapping, I3D 2010). A
// metal has no diffuse part, its base colour is its reflectance. Throws Failure(INVALID_ARGUMENT) where the
// height scale is negative, the side is not above 0, or the surface is higher than half a tile.
MesoSurface surface_of_maps(const PbrMaps& maps, float height_scale_m, float side_m);

}  // namespace nook::bake::material
