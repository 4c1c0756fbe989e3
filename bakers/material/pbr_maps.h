// The maps of a physically based material, and the surface that they stand for.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/material/meso_surface.h"

namespace nook::bake::material {

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
