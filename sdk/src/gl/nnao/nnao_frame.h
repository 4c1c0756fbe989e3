// A frame of the screen-space pass as the stages read it: the host's images and camera, and the settings.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <nook/nook_nnao.h>

namespace nook::gl {

struct NnaoFrame : nook_gl_frame_desc, nook_nnao_frame_desc {
  nook_nnao_view show = NOOK_NNAO_VIEW_AO;
};

// The settings of a pass, with the preset's numbers in place of -1.
struct NnaoSettings : nook_nnao_desc {
  nook_nnao_path path = NOOK_NNAO_PATH_AUTOMATIC;
  nook_nnao_sample depth_sample = NOOK_NNAO_SAMPLE_MEDIAN;
  bool timers = false;
};

}  // namespace nook::gl
