// Checks of what a host says about a frame of the screen-space pass.
#pragma once

#include <nook/nook_nnao.h>

#include "sdk/src/gl/nnao/nnao_frame.h"

namespace nook::gl {

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT), naming the field, unless every number of the frame is in range
// for a pass of this size. Makes no OpenGL call.
void check_frame(const NnaoFrame& frame, const nook_nnao_desc& pass);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless frame.view is a rotation with a translation.
void check_view(const float (&view)[16]);

}  // namespace nook::gl
