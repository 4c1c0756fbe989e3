// The error with which a driver weighs the texels between which it filters.
#pragma once

#include <glad/gl.h>

namespace nook::test {

// Returns the largest error of the weights of linear filtering, measured between a black and a white texel.
// Graphics processors have about eight bits for them, an error of 1/512, as if the place were moved by 1/512
// of a texel; llvmpipe has float weights.
float filter_weight_error(const GladGLContext& gl);

}  // namespace nook::test
