// The choice between a draw and a dispatch for the network.
#pragma once

#include <nook/experimental/nook_debug.h>

#include "sdk/src/gl/functions.h"

namespace nook::gl {

// Returns NOOK_NNAO_PATH_FRAGMENT or NOOK_NNAO_PATH_COMPUTE for the path of a descriptor. Throws
// Failure(NOOK_ERROR_UNSUPPORTED) if the path is compute and compute is not available.
nook_nnao_path chosen_path(const Functions& gl, nook_nnao_path asked);

}  // namespace nook::gl
