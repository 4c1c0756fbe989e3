// Decodes a material on the CPU from the same tables that the GPU uses. Tests compare shaders/material with
// these functions.
#pragma once

#include <span>

#include "sdk/src/core/vec.h"
#include "sdk/src/material/footprint.h"
#include "sdk/src/material/tables.h"

namespace nook::material {

struct Sample {
  float u = 0, v = 0;  // the tile repeats
  // Mipmap level: 0 if a texel of the material is as large as a pixel, 1 if it is half as large as a pixel.
  float level = 0;
  Vec3 view;  // unit vectors in tangent space, away from the surface
  Vec3 light;
};

// A pixel of a picture. Its value is the mean over its footprint. The material is read at up to `fetches`
// places (1 to max_fetches) along the longer axis of the footprint; see footprint.h.
struct Pixel {
  PixelSides sides;
  Vec3 view, light;  // as in Sample
  std::uint32_t fetches = 2;
};

struct Radiance {
  float red = 0, green = 0, blue = 0;
};

// Returns the radiance for a light that causes an irradiance of 1 on a plane facing the light. The result is
// black if the light is below the horizon. Because of compression, values may be slightly negative, except in
// a neural material.
Radiance evaluate_btf(const MaterialTables& tables, const Sample& sample);
Radiance evaluate_btf_pixel(const MaterialTables& tables, const Pixel& pixel);
// Computes the light modes for the point and view of the sample. sample.light is not used. `modes` has
// light_modes values. Not for neural materials, which have no light modes; see refuse_neural in
// material_check.h.
void decode_modes(const MaterialTables& tables, const Sample& sample, std::span<float> modes);
void decode_pixel_modes(const MaterialTables& tables, const Pixel& pixel, std::span<float> modes);
// Computes the light basis for a light direction: 3 x light_modes values, channel by channel. All values are
// 0 if the light is below the horizon. The radiance is the product of this basis with the light modes.
void light_basis_at(const MaterialTables& tables, Vec3 light, std::span<float> basis);
// Returns the value of the VOTF, which is a filtered mask or signed distance. Returns 1 if the material has
// no VOTF.
float evaluate_votf(const MaterialTables& tables, const Sample& sample);
float evaluate_votf_pixel(const MaterialTables& tables, const Pixel& pixel);
// Applies the visibility mapping, equation (26), and clamps the result to [0, 1].
float visibility_of(VisibilityForm form, const VisibilityMapping& mapping, float value);

// Returns the fraction of uniform light that a plane of the material reflects, as RGB. It is the mean over
// all texels of radiosity / irradiance. The VOTF is ignored. Each channel is clamped to [0, 1], because
// compression errors may push it outside.
Vec3 mean_reflectance(const MaterialTables& tables);

}  // namespace nook::material
