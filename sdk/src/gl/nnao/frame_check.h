// Checks of what a host says about a frame of the screen-space pass.
#pragma once

#include <nook/nook_nnao.h>

namespace nook::gl {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT), naming the field, unless every number of the frame is in range
// for a pass of this size. Makes no OpenGL call.
void check_frame(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass);

}  // namespace nook::gl
