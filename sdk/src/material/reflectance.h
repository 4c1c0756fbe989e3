// A material decoded on the CPU, from the same tables as on the GPU. This is the reference of
// shaders/material.
#pragma once

#include <span>

#include "sdk/src/core/vec.h"
#include "sdk/src/material/footprint.h"
#include "sdk/src/material/tables.h"

namespace nook::material {

struct Sample {
  float u = 0, v = 0;  // the tile repeats
  // Mipmap level: 0 where a texel of the material has the size of a pixel, 1 where it has half that size.
  float level = 0;
  Vec3 view;  // unit vectors in tangent space, away from the surface
  Vec3 light;
};

// A pixel of a picture, which shows the mean over its footprint and reads `fetches` places along the longer
// side of it, 1 to max_fetches; see footprint.h.
struct Pixel {
  PixelSides sides;
  Vec3 view, light;  // as in Sample
  std::uint32_t fetches = 2;
};

struct Radiance {
  float red = 0, green = 0, blue = 0;
};

// Returns the radiance for an irradiance of 1 on a plane that faces the light; it is black for light from
// below the horizon. Compression may leave it slightly negative, but for a neural material.
Radiance evaluate_btf(const MaterialTables& tables, const Sample& sample);
Radiance evaluate_btf_pixel(const MaterialTables& tables, const Pixel& pixel);
// Computes the light modes of the sample's point for its view, light_modes numbers; the light is not read. A
// neural material has none, see refuse_neural in material_check.h.
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

// Returns the share of light that a plane of the material reflects under even light from all directions, RGB:
// the mean over its texels of radiosity over irradiance. The VOTF does not count. Each number is clamped to
// [0, 1], because compression may leave a material of little noise outside.
Vec3 mean_reflectance(const MaterialTables& tables);

}  // namespace nook::material
