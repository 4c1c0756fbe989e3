// Creates the texture arrays of a material and of its coordinates.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

enum class ArrayUse {
  spatial,       // half floats, mipmaps, linear, repeated
  coefficients,  // half floats, nearest
  membership,    // 16-bit integers, nearest
  membership_8,  // 8-bit integers, nearest
  light,         // floats, linear, clamped to the edge
  spatial_8,     // signed 8-bit integers for -1 to 1; otherwise like spatial
  light_8,       // signed 8-bit integers for -1 to 1; otherwise like light
  rgtc,          // blocks of two numbers from -1 to 1; otherwise like spatial
  eac,           // like rgtc, in the EAC format
  coordinates,   // pairs of 16-bit integers, nearest
  heights        // one half float; otherwise like spatial
};

struct ArrayPlan {
  ArrayUse use = ArrayUse::spatial;
  GLsizei width = 0, height = 0;
  GLsizei first_layer = 0, layers = 0;
  GLsizei all_layers = 0;  // number of layers in `data`, which may also contain the layers of other arrays
  GLsizei levels = 1;
};

// Creates a GL_TEXTURE_2D_ARRAY. A texel has four channels; coordinates and blocks have two channels, and
// heights have one. `data` contains all layers of level 0, then all layers of level 1, and so on. Changes
// GL_TEXTURE_2D_ARRAY of unit 0. Call set_plain_unpacking before. Throws Failure.
Object make_texture_array(Device& device, const ArrayPlan& plan, const void* data, const char* label);

// Sets the pixel-unpack state for tightly packed data in host memory.
void set_plain_unpacking(const Functions& gl);

}  // namespace nook::gl
