// A texture array of a material, with the contents that it keeps.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

enum class ArrayUse {
  spatial,       // half floats, mipmaps, linear, repeated
  coefficients,  // half floats, nearest
  membership,    // 16-bit integers, nearest
  light          // floats, linear, to the edge
};

struct ArrayPlan {
  ArrayUse use = ArrayUse::spatial;
  GLsizei width = 0, height = 0;
  GLsizei first_layer = 0, layers = 0;
  GLsizei all_layers = 0;  // of the data, of which these are a part
  GLsizei levels = 1;
};

// GL_TEXTURE_2D_ARRAY of four numbers a texel. `data` are all layers of level 0, then of level 1 and on.
// Binds unit 0's array, and expects plain pixel unpacking. Throws Failure.
Object make_texture_array(Device& device, const ArrayPlan& plan, const void* data, const char* label);

// Of unpacking from the host's memory without gaps.
void set_plain_unpacking(const Functions& gl);

}  // namespace nook::gl
