// Checks the host's projection matrix. A matrix that cannot belong to a camera is rejected, and the message
// names the likely mistake.
#pragma once

#include "sdk/src/nnao/host_depth.h"

namespace nook::nnao {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless the matrix is the projection of a camera that looks
// along -z, without roll and shear. `clip` is used only for hardware depth.
void check_projection(const float (&projection)[16], DepthKind kind, ClipRange clip);

}  // namespace nook::nnao
