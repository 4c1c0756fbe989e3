// A frame of the screen-space pass, with the host's images, camera and settings. Checks them and computes the
// uniforms of the stages.
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

// The settings of a pass. Fields that are -1 in the host's descriptor are already replaced by the values of
// the preset.
struct NnaoSettings : nook_nnao_desc {
  nook_nnao_path path = NOOK_NNAO_PATH_AUTOMATIC;
  nook_nnao_sample depth_sample = NOOK_NNAO_SAMPLE_MEDIAN;
  bool timers = false;
};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if a field of the frame is out of range for a pass of this
// size. The message names the field. Makes no OpenGL calls.
void check_frame(const NnaoFrame& frame, const nook_nnao_desc& pass);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless frame.view is a rotation with a translation.
void check_view(const float (&view)[16]);

// A rectangle in pixels of the host's textures.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};
Viewport viewport_of(const NnaoFrame& frame);

// Returns the width or height of the surface, which is the image at the resolution of AO (full or half).
constexpr int surface_length(int length, bool half) {
  return half ? (length + 1) / 2 : length;
}

// The values of the uniform array nook_frame in frame.glsl.
struct FrameConstants {
  std::array<float, NOOK_FRAME_VEC4S * 4> values{};
};

// The frame must have passed check_frame. `count` is the number of frames that the pass has drawn. If
// max_history_frames is set, the noise of the taps is shifted by an amount that depends on `count`. `layer`
// is the layer of the host's texture arrays, for passes with views.
FrameConstants frame_constants(const NnaoFrame& frame, const nook_nnao_desc& pass, std::uint32_t count,
                               int layer = 0);

// Returns a copy of the frame with the matrices of one layer.
NnaoFrame layer_frame(const NnaoFrame& frame, int layer);

// Returns the number of layers to draw in a frame. If the images are not texture arrays, this is 1.
constexpr int drawn_layers(const nook_nnao_desc& pass) {
  return pass.views > 0 ? pass.views : 1;
}
inline constexpr int max_layers = 8;

// What the pass remembers about the previous frame.
struct EarlierFrame {
  std::uint32_t count = 0;  // number of frames since the pass was created
  bool drawn = false;       // false: there is no previous frame
  FrameConstants constants;
  int width = 0, height = 0;  // size of the surface
  float view[16] = {};        // view matrix, from world space
};

using HistoryConstants = std::array<float, 4 * NOOK_EARLIER_VEC4S>;

// Returns the matrix from the current view space to the earlier one, which is the earlier view matrix times
// the inverse of `view`.
Mat3x4 earlier_from_view(const float (&earlier)[16], const float (&view)[16]);

// Returns the values of the uniform array nook_earlier. After a cut (see nook_nnao_frame_desc.reset), the
// mean contains only the current frame.
HistoryConstants history_constants(const NnaoFrame& frame, const nook_nnao_desc& pass,
                                   const FrameConstants& constants, const EarlierFrame& earlier);

}  // namespace nook::gl
