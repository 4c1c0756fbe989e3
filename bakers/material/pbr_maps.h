// Physically based materials: their reflection, their maps, and the surface that the maps describe.
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
// Smoother surfaces shine like this one. Otherwise their highlights would fall between sampled directions.
inline constexpr float least_roughness = 0.1f;

// Returns the GGX width of a perceptual roughness of 0 to 1: its square. Roughness below least_roughness
// counts as least_roughness.
float ggx_width(float roughness);

struct Reflector {
  Vec3 diffuse;      // linear RGB; metals have less of it
  Vec3 reflectance;  // at normal incidence, linear RGB
  float width = 1;   // GGX width
};

// Returns pi times the BRDF, so that a white Lambertian surface gives 1. Pass unit vectors away from the
// surface, with the light above it. A view below 3 degrees counts as one at 3 degrees.
Vec3 microfacet_reflection(const Reflector& surface, Vec3 normal, Vec3 view, Vec3 light);

// The slopes of a surface around a point: dz / dx and dz / dy, and the mean of their variances.
struct MapSlope {
  float x = 0, y = 0, variance = 0;
};

// Values at a grid of points of the tile, y * side + x at ((x + 0.5) / side, (y + 0.5) / side). The tile
// repeats. Only the base colour is required.
struct PbrMaps {
  std::uint32_t side = 0;
  std::vector<Vec3> base_colour;     // linear RGB
  std::vector<float> height;         // in units of a height scale; empty: flat
  std::vector<MapSlope> slope;       // from a normal map; empty: slopes come from the heights
  std::vector<float> squared_width;  // the mean square of GGX's width; empty: 1, which is matte
  std::vector<float> metalness;      // 0 to 1; empty: 0
};

// Returns the heights of a map in tiles, with their middle at 0: values times height_scale_m over side_m.
// Returns nothing for a flat map. Throws what surface_of_maps() throws.
std::vector<float> heights_of_map(const PbrMaps& maps, float height_scale_m, float side_m);

// Returns only the heights at side x side points, as TileFilter averages them.
PbrMaps heights_at(const PbrMaps& maps, std::uint32_t side);

// Makes the displaced surface. Heights in tiles are the map's heights times height_scale_m over side_m, and
// the middle of the heights is z = 0. Normals for shading come from the slopes. Slopes that vary around a
// point widen its gloss: twice their variance is added to the squared width (M. Olano, D. Baker, LEAN
// Mapping, I3D 2010). A metal has no diffuse part, and its base colour is its reflectance. Throws
// Failure(INVALID_ARGUMENT) if the height scale is negative, the side is not above 0, or the surface is
// higher than half a tile.
MesoSurface surface_of_maps(const PbrMaps& maps, float height_scale_m, float side_m);

}  // namespace nook::bake::material
