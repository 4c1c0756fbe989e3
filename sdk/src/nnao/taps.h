// Computes the positions of a pixel's taps. The functions depend only on the pixel and the radius, and are
// the same as in the shader. Pixel (0, 0) is at the lower left, and y points up. The centre of pixel (x, y)
// is at (x + 0.5, y + 0.5).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sdk/src/nnao/network.h"

namespace nook::nnao {

// Two values in [0, 1) that vary the taps from pixel to pixel. In a block of 3 x 3 pixels, each value lies
// once in each ninth of [0, 1). The 9 pairs of ninths form the Hammersley set in base 3. The filter gives all
// nine the same total weight.
struct TapNoise {
  float rotation = 0.5f, offset = 0.5f;
};

// Returns the offset that is added to the noise in a frame. The offsets are M. Roberts' sequence R2. They
// ensure that a mean over several frames uses more directions and distances.
inline TapNoise frame_noise_step(std::uint32_t frame) {
  constexpr double rotation = 0.7548776662466927, offset = 0.5698402909980532;
  return {float(std::fmod(rotation * frame, 1.0)), float(std::fmod(offset * frame, 1.0))};
}

// Returns two values in [0, 1) that look random from pixel to pixel.
constexpr TapNoise tap_jitter(std::uint32_t x, std::uint32_t y) {
  std::uint32_t hash = (x | y << 16) * 0x7FEB352Du;
  hash = (hash ^ hash >> 15) * 0x846CA68Bu;
  hash ^= hash >> 16;
  return {float(hash >> 16) / 65536, float(hash & 0xFFFFu) / 65536};
}

// `within` is the place within the ninths.
constexpr TapNoise tap_noise_of_rank(std::uint32_t rank, TapNoise within = {}) {
  constexpr std::uint32_t size = NOOK_NOISE_SIZE, count = NOOK_NOISE_COUNT;
  const std::uint32_t reversed = rank % size * size + rank / size;
  return {(float(rank) + within.rotation) / count, (float(reversed) + within.offset) / count};
}

// The place within the ninths is random. With equal places, the shadow of one edge would appear several
// times, at the same distances from the edge for all pixels.
constexpr TapNoise tap_noise(std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t size = NOOK_NOISE_SIZE;
  return tap_noise_of_rank(x % size * size + y % size, tap_jitter(x, y));
}

// An offset from the centre of the pixel.
struct TapOffset {
  float x_px = 0, y_px = 0;
};

// Pixels per metre in view space at the pixel's depth. A negative value means that the screen's axis and the
// axis of view space have opposite directions.
struct PixelScale {
  float x = 1, y = 1;
};

// The default number of taps. The best preset has best_taps.
inline constexpr std::uint32_t default_taps = 9, best_taps = 32;

struct TapGrid {
  std::uint32_t directions = 0, steps = 0;
};
// Divides the taps into directions and steps. Returns an empty grid for an unknown number of taps.
constexpr TapGrid horizon_grid(std::uint32_t taps) {
  switch (taps) {
    case 9:
      return {3, 3};
    case 16:
      return {4, 4};
    case 32:
      return {8, 4};
    case 64:
      return {8, 8};
    case 128:
      return {16, 8};
    case 256:
      return {16, 16};
    default:
      return {};
  }
}

// Returns the angle of a direction in the view-space x-y plane, in radians.
inline float direction_angle(std::uint32_t direction, std::uint32_t directions, TapNoise noise) {
  return 6.2831853f * (float(direction) + noise.rotation) / float(directions);
}

// Returns the distance of a step from the pixel, in pixels of the screen's y axis. Distances grow with the
// step index to the power 3/2. So more taps are near the pixel, because near occluders cover more of the
// hemisphere. No two steps fall on the same pixel.
inline float step_distance_px(std::uint32_t step, std::uint32_t steps, TapNoise noise, float radius_px) {
  const float share = (float(step) + noise.offset) / float(steps);
  return std::max(float(step) + 1, radius_px * share * std::sqrt(share));
}

inline TapOffset horizon_tap(float cosine, float sine, float distance_px, PixelScale scale) {
  const float per_y = distance_px / std::abs(scale.y);
  return {cosine * scale.x * per_y, sine * scale.y * per_y};
}

// Returns the grid cell of tap index `tap` if only `taps` cells of the paper's grid are used. The used cells
// are every (grid_size^2 / taps)-th cell in raster order.
constexpr std::uint32_t paper_tap_cell(std::uint32_t tap, std::uint32_t taps, TapNoise noise) {
  constexpr std::uint32_t cells = PaperNetwork::grid_size * PaperNetwork::grid_size;
  return std::min(std::uint32_t((float(tap) + noise.rotation) * (float(cells) / float(taps))), cells - 1);
}

// Returns the position of the tap in a cell. If only some cells are used, the noise moves the tap within half
// a cell. If all cells are used, the taps do not move.
inline TapOffset paper_tap(std::uint32_t cell, std::uint32_t taps, TapNoise noise, float radius,
                           PixelScale scale) {
  constexpr std::uint32_t size = PaperNetwork::grid_size;
  float column = float(cell % size) + 0.5f, row = float(cell / size) + 0.5f;
  if (taps < size * size) {
    const float quarter = 4 * noise.rotation;
    column += noise.offset - 0.5f;
    row += quarter - std::floor(quarter) - 0.5f;
  }
  return {radius * (2 * column / size - 1) * scale.x, radius * (2 * row / size - 1) * scale.y};
}

}  // namespace nook::nnao
