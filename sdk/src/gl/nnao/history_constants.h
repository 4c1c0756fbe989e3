// The constants of the stage that blends a frame with those before it.
#pragma once

#include <nook/nook_nnao.h>

#include <array>

#include "sdk/src/core/vec.h"
#include "sdk/src/gl/nnao/frame_constants.h"
#include "sdk/src/gl/nnao/nnao_frame.h"

namespace nook::gl {

// The frame before, as the pass keeps it.
struct EarlierFrame {
  std::uint32_t count = 0;  // frames since the pass was made
  bool drawn = false;       // false: there is none
  FrameConstants constants;
  int width = 0, height = 0;  // of the surface
  float view[16] = {};        // from world space
};

using HistoryConstants = std::array<float, 4 * NOOK_EARLIER_VEC4S>;

// From the view space of the present frame to the view space of the one before: the earlier view matrix times
// the inverse of this one.
Mat3x4 earlier_from_view(const float (&earlier)[16], const float (&view)[16]);

// Fills the uniform array nook_earlier. A cut, see nook_nnao_frame_desc.reset, has a mean of one frame.
HistoryConstants history_constants(const NnaoFrame& frame, const nook_nnao_desc& pass,
                                   const FrameConstants& constants, const EarlierFrame& earlier);

}  // namespace nook::gl
