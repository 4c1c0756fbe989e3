// The same tile as the maps that artists use: base colour, normal, roughness and height. Relief mapping draws
// it (F. Policarpo, M. Oliveira, J. Comba, 2005). Its maps are fitted to a raw material.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/material/btf_error.h"
#include "bakers/material/raw_material.h"

namespace nook::lab {

// Maps of a tile, texel x * height + y. They are read linearly and repeat.
struct PbrTile {
  std::uint32_t width = 0, height = 0;
  std::vector<float> heights;           // over the plane z = 0, tiles
  std::vector<Vec3> diffuse;            // linear RGB, for a dielectric of reflectance 0.04
  std::vector<float> slope_x, slope_y;  // for the shading normal
  std::vector<float> gloss_width;       // GGX width
  bool has_shadows = true;              // shadows of the relief, marched towards each light

  std::size_t texels() const { return std::size_t(width) * height; }
  // Counts eight bits per number: three of colour, two of slopes, one of roughness and one of height.
  std::size_t bytes() const { return 7 * texels(); }
};

// Returns the radiance of the plane's texels in a view for each light, 3 lights x texels, as in
// RawMaterial::btf.
bake::tensor::Matrix draw_pbr_tile(const PbrTile& tile, Vec3 view, std::span<const Vec3> lights);

// Finds the heights by heights_of_views. The other maps are least squares in each texel, over all lights and
// the views that see it.
PbrTile fit_pbr_tile(const bake::material::RawMaterial& raw, bool has_shadows);

// Compares with raw data of any views and lights.
bake::material::BtfError measure_pbr_tile(const bake::material::RawMaterial& raw, const PbrTile& tile);

}  // namespace nook::lab
