// Decodes a material on the CPU, from the same tables as on the GPU. Tests compare shaders/material with it.
#pragma once

#include <span>

#include "sdk/src/core/vec.h"
#include "sdk/src/material/footprint.h"
#include "sdk/src/material/tables.h"

namespace nook::material {

struct Sample {
  float u = 0, v = 0;  // the tile repeats
  // Mipmap level: 0 if a texel of the material is as large as a pixel, 1 if it is half as large.
  float level = 0;
  Vec3 view;  // unit vectors in tangent space, away from the surface
  Vec3 light;
};

// A pixel of a picture. It shows the mean over its footprint, read at `fetches` places along the longer side,
// 1 to max_fetches; see footprint.h.
struct Pixel {
  PixelSides sides;
  Vec3 view, light;  // as in Sample
  std::uint32_t fetches = 2;
};

struct Radiance {
  float red = 0, green = 0, blue = 0;
};

// Returns the radiance for an irradiance of 1 on a plane that faces the light; it is black for light from
// below the horizon. Compression may leave it slightly negative, except in a neural material.
Radiance evaluate_btf(const MaterialTables& tables, const Sample& sample);
Radiance evaluate_btf_pixel(const MaterialTables& tables, const Pixel& pixel);
// Computes the light_modes light modes of the sample's point for its view, without reading the light. A
// neural material has none; see refuse_neural in material_check.h.
void decode_modes(const MaterialTables& tables, const Sample& sample, std::span<float> modes);
void decode_pixel_modes(const MaterialTables& tables, const Pixel& pixel, std::span<float> modes);
// Computes the light basis for a light from a direction, 3 x light_modes numbers, channel by channel; it is 0
// below the horizon. The radiance is its product with the light modes.
void light_basis_at(const MaterialTables& tables, Vec3 light, std::span<float> basis);
// Returns the value of the VOTF, a filtered mask or signed distance, or 1 if the material has none.
float evaluate_votf(const MaterialTables& tables, const Sample& sample);
float evaluate_votf_pixel(const MaterialTables& tables, const Pixel& pixel);
// Equation (26), clamped to [0, 1].
float visibility_of(VisibilityForm form, const VisibilityMapping& mapping, float value);

// Returns the share of even light from all directions that a plane of the material reflects, RGB: the mean
// over its texels of radiosity over irradiance. The VOTF is ignored. Each number is clamped to [0, 1],
// because compression may push it outside.
Vec3 mean_reflectance(const MaterialTables& tables);

}  // namespace nook::material
