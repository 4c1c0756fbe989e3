// CPU version of the stage that averages AO over frames, shaders/nnao/accumulate.frag. Tests compare the
// OpenGL pass with this version.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/nnao/network_evaluate.h"

namespace nook::nnao {

// The history, which the pass keeps from the previous frame. For each pixel, it contains the depth, the mean
// AO and the number of frames in this mean.
struct History {
  std::uint32_t width = 0, height = 0;
  ScreenRays rays;
  std::span<const float> depth;   // metres, infinity or NaN for the sky
  std::span<const float> ao;      // mean AO
  std::span<const float> frames;  // frames in the mean; 0: no history
  Mat3x4 earlier_from_view;       // maps the view space of the current frame to the view space of the
                                  // previous frame
};

// The current frame.
struct PresentAo {
  View view;
  std::span<const float> ao;            // before the filter
  std::span<const std::uint8_t> edges;  // packed_edges
  std::span<const float> motion;        // motion vectors: x and y for each pixel, in pixels; may be empty
  std::uint32_t taps = default_taps;
  float tolerance = 0.03f;  // metres; nook_nnao_desc: radius / blur_sharpness
};

// Returns the noise of a pixel in a frame; see frame_noise_step.
TapNoise noise_of_frame(TapNoise noise, std::uint32_t frame);

// Returns the approximate amplitude of the noise that the taps cause in AO. The mean of earlier frames is
// clamped so that it differs from the pixel's current AO by at most this value. With a larger value, AO would
// flicker less, but dark lines that are one pixel wide would be lost.
constexpr float noise_reach(std::uint32_t taps) {
  return taps < 16 ? 0.2f : taps < 32 ? 0.12f : 0.08f;
}

struct MeanAo {
  float ao = 1, frames = 0;
};
// Returns the mean AO of a pixel over at most max_frames frames, including the current one.
MeanAo accumulated(const PresentAo& present, const History& history, std::uint32_t x, std::uint32_t y,
                   std::uint32_t max_frames);

}  // namespace nook::nnao
