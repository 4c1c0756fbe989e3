// Represents a material tile by the maps that artists use: base colour, normal, roughness and height. The
// maps are fitted to a raw material. Relief mapping draws the tile (F. Policarpo, M. Oliveira, J. Comba,
// 2005).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/material/btf_error.h"
#include "bakers/material/raw_material.h"

namespace nook::lab {

// Maps of a tile. The index of a texel is x * height + y. The maps are interpolated linearly and repeat.
struct PbrTile {
  std::uint32_t width = 0, height = 0;
  std::vector<float> heights;           // above the plane z = 0, in units of the tile size
  std::vector<Vec3> diffuse;            // linear RGB of a dielectric with reflectance 0.04
  std::vector<float> slope_x, slope_y;  // slopes of the shading normal
  std::vector<float> gloss_width;       // GGX width
  bool has_shadows = true;              // whether the relief casts shadows, by a march towards each light

  std::size_t texels() const { return std::size_t(width) * height; }
  // Returns the size with eight bits per value. A texel has three values of colour, two of slopes, one of
  // roughness and one of height.
  std::size_t bytes() const { return 7 * texels(); }
};

// Returns the radiance of all texels in one view, for each light. The matrix has 3 lights x texels, as in
// RawMaterial::btf.
bake::tensor::Matrix draw_pbr_tile(const PbrTile& tile, Vec3 view, std::span<const Vec3> lights);

// Fits a tile to a raw material. The heights are from heights_of_views. The other maps are least-squares fits
// per texel, over all lights and over the views that see the texel.
PbrTile fit_pbr_tile(const bake::material::RawMaterial& raw, bool has_shadows);

// Compares the tile with a raw material, which may have other views and lights.
bake::material::BtfError measure_pbr_tile(const bake::material::RawMaterial& raw, const PbrTile& tile);

}  // namespace nook::lab
