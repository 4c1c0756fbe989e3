// A frame of the screen-space pass as the stages read it: the host's images, camera and settings, their
// checks, and the uniforms that depend on them.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <nook/nook_nnao.h>

#include <array>
#include <cstdint>

#include "sdk/src/core/vec.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {

struct NnaoFrame : nook_gl_frame_desc, nook_nnao_frame_desc {
  nook_nnao_view show = NOOK_NNAO_VIEW_AO;
  bool normalised_normals = false;  // normal_texture has normalised integers
};

// The settings of a pass. Where the descriptor has -1, they have the preset's number.
struct NnaoSettings : nook_nnao_desc {
  nook_nnao_path path = NOOK_NNAO_PATH_AUTOMATIC;
  nook_nnao_sample depth_sample = NOOK_NNAO_SAMPLE_MEDIAN;
  bool timers = false;
};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT), naming the field, unless every number of the frame is in range
// for a pass of this size. Makes no OpenGL call.
void check_frame(const NnaoFrame& frame, const nook_nnao_desc& pass);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless frame.view is a rotation with a translation.
void check_view(const float (&view)[16]);

// x, y, width and height in pixels of the host's textures.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};
Viewport viewport_of(const NnaoFrame& frame);

// Returns the length of the surface, the image at the resolution at which AO is computed.
constexpr int surface_length(int length, bool half) {
  return half ? (length + 1) / 2 : length;
}

// The uniform array nook_frame of frame.glsl.
struct FrameConstants {
  std::array<float, NOOK_FRAME_VEC4S * 4> values{};
};

// The frame must have passed check_frame. count: the frames that the pass has drawn; with max_history_frames,
// it shifts the noise of the taps. layer: of the host's texture arrays, for passes with views.
FrameConstants frame_constants(const NnaoFrame& frame, const nook_nnao_desc& pass, std::uint32_t count,
                               int layer = 0);

// Returns the frame of one layer, with the layer's matrices.
NnaoFrame layer_frame(const NnaoFrame& frame, int layer);

// Returns the number of layers in a frame: 1 unless its images are texture arrays.
constexpr int drawn_layers(const nook_nnao_desc& pass) {
  return pass.views > 0 ? pass.views : 1;
}
inline constexpr int max_layers = 8;

// What the pass keeps of the frame before.
struct EarlierFrame {
  std::uint32_t count = 0;  // frames since the pass was made
  bool drawn = false;       // false: there is none
  FrameConstants constants;
  int width = 0, height = 0;  // of the surface
  float view[16] = {};        // from world space
};

using HistoryConstants = std::array<float, 4 * NOOK_EARLIER_VEC4S>;

// Returns the map from the current frame's view space to the earlier one's: the earlier view matrix times the
// inverse of this one.
Mat3x4 earlier_from_view(const float (&earlier)[16], const float (&view)[16]);

// Fills the uniform array nook_earlier. A cut, see nook_nnao_frame_desc.reset, has a mean of one frame.
HistoryConstants history_constants(const NnaoFrame& frame, const nook_nnao_desc& pass,
                                   const FrameConstants& constants, const EarlierFrame& earlier);

}  // namespace nook::gl
