// Whether the network's stage is a draw or a dispatch.
#pragma once

#include <nook/nook_nnao.h>

#include "sdk/src/gl/functions.h"

namespace nook::gl {

// NOOK_NNAO_PATH_FRAGMENT or NOOK_NNAO_PATH_COMPUTE for what a description asks. Throws
// Failure(NOOK_ERROR_UNSUPPORTED) where compute is asked for and cannot be had.
nook_nnao_path chosen_path(const Functions& gl, nook_nnao_path asked);

}  // namespace nook::gl
