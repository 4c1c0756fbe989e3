// The uniforms of the screen-space pass that depend on the frame, from the host's descriptor.
#pragma once

#include <nook/nook_nnao.h>

#include <array>
#include <cstdint>

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {

// x, y, width and height in pixels of the host's textures.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};
Viewport viewport_of(const NnaoFrame& frame);

// The length of the surface, which is the image at the resolution at which AO is computed.
constexpr int surface_length(int length, bool half) {
  return half ? (length + 1) / 2 : length;
}

// The uniform array nook_frame of frame.glsl.
struct FrameConstants {
  std::array<float, NOOK_FRAME_VEC4S * 4> values{};
};

// The frame must have passed check_frame. count: the frames that the pass has drawn, which turns the noise of
// the taps of passes with max_history_frames.
// layer: of the host's texture arrays, for passes with views.
FrameConstants frame_constants(const NnaoFrame& frame, const nook_nnao_desc& pass, std::uint32_t count,
                               int layer = 0);

// Returns the frame of one layer: its matrices are those of the layer.
NnaoFrame layer_frame(const NnaoFrame& frame, int layer);

// The layers that a frame of the pass has: 1 unless its images are texture arrays.
constexpr int drawn_layers(const nook_nnao_desc& pass) {
  return pass.views > 0 ? pass.views : 1;
}
inline constexpr int max_layers = 8;

}  // namespace nook::gl
