// A material decoded on the CPU, from the same tables as on the GPU: the reference of shaders/material.
#pragma once

#include "sdk/src/core/vec.h"
#include "sdk/src/material/tables.h"

namespace nook::material {

struct Sample {
  float u = 0, v = 0;  // the tile repeats
  float level = 0;     // mipmap level: 0 where a texel of the material is as large as a pixel, 1 at half that
  Vec3 view;           // unit vectors in tangent space, away from the surface
  Vec3 light;
};

struct Radiance {
  float red = 0, green = 0, blue = 0;
};

// Radiance for an irradiance of 1 on a plane that faces the light; black from below the horizon. Compression
// may leave it slightly negative.
Radiance evaluate_btf(const MaterialTables& tables, const Sample& sample);
// The VOTF's value, a filtered mask or signed distance; 1 where the material has none.
float evaluate_votf(const MaterialTables& tables, const Sample& sample);
// Equation (26), clamped to [0, 1].
float visibility_of(VisibilityForm form, const VisibilityMapping& mapping, float value);

}  // namespace nook::material
