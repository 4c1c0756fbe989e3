// What a host gives as its projection: a matrix that no camera has is refused, and the message says what the
// matrix seems to be.
#pragma once

#include "sdk/src/nnao/host_depth.h"

namespace nook::nnao {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless the matrix is the projection of a camera that looks
// along -z, without roll and shear. The clip range counts for hardware depth alone.
void check_projection(const float (&projection)[16], DepthKind kind, ClipRange clip);

}  // namespace nook::nnao
