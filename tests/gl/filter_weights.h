// The error with which a driver weighs the texels between which it filters.
#pragma once

#include <glad/gl.h>

namespace nook::test {

// Returns the largest error of the weights of linear filtering, measured between a black and a white texel.
// Graphics processors have about eight bits for them, an error of 1/512, which is as if the place were moved
// by as much of a texel; llvmpipe has those of a float.
float filter_weight_error(const GladGLContext& gl);

}  // namespace nook::test
