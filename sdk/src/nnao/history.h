// Averages AO over frames, one pixel at a time. Tests compare the OpenGL pass with it; the stage is
// shaders/nnao/accumulate.frag.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/nnao/network_evaluate.h"

namespace nook::nnao {

// What remains of an earlier frame: its depths, and for each pixel a mean of AO and the number of frames in
// it.
struct History {
  std::uint32_t width = 0, height = 0;
  ScreenRays rays;
  std::span<const float> depth;   // metres, not finite for the sky
  std::span<const float> ao;      // means
  std::span<const float> frames;  // 0: none
  Mat3x4 earlier_from_view;       // from the view space of the current frame to the earlier frame's
};

// The current frame.
struct PresentAo {
  View view;
  std::span<const float> ao;            // before the filter
  std::span<const std::uint8_t> edges;  // packed_edges
  std::span<const float> motion;        // two numbers for each pixel, in pixels; empty: none
  std::uint32_t taps = default_taps;
  float tolerance = 0.03f;  // metres; nook_nnao_desc: radius / blur_sharpness
};

// Returns the noise of a pixel in a frame; see frame_noise_step.
TapNoise noise_of_frame(TapNoise noise, std::uint32_t frame);

// The noise of the taps moves AO about this far from its mean. The mean of earlier frames may differ from a
// pixel's AO by this much at most. Wider bounds flicker less, but lose dark lines that are one pixel wide.
constexpr float noise_reach(std::uint32_t taps) {
  return taps < 16 ? 0.2f : taps < 32 ? 0.12f : 0.08f;
}

struct MeanAo {
  float ao = 1, frames = 0;
};
// Returns the mean of a pixel with at most max_frames frames.
MeanAo accumulated(const PresentAo& present, const History& history, std::uint32_t x, std::uint32_t y,
                   std::uint32_t max_frames);

}  // namespace nook::nnao
