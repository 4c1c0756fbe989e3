// A frame of the screen-space pass as the stages read it: the host's images and camera, and the settings.
#pragma once

#include <nook/nook_nnao.h>

namespace nook::gl {

struct NnaoFrame : nook_gl_frame_desc, nook_nnao_frame_desc {};

}  // namespace nook::gl
