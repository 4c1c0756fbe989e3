// Finds the places of the tile that a pixel reads when it filters along the longer side of its footprint.
// shaders/material/footprint.glsl has the same functions.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/relief_tables.h"

namespace nook::material {

inline constexpr std::uint32_t max_fetches = 8;

// A pixel reads the mean over the first `count` places; they share one level.
struct Fetches {
  std::uint32_t count = 1;  // 1 to max_fetches
  std::array<ImagePlace, max_fetches> place{};
};

inline Fetches one_fetch(const ImagePlace& place) {
  Fetches at;
  at.place[0] = place;
  return at;
}

// The texture coordinates of a pixel's centre, and their changes to the neighbours on the right and above, as
// dFdx and dFdy return them.
struct PixelSides {
  TexturePlace middle, dx, dy;
};

// Returns places at equal steps along the longer axis of the ellipse with the pixel's second moments. Each
// stands for a square of the texture. Its side is the ellipse's shorter axis, or larger if `count` squares
// would leave gaps on the longer axis. The outermost squares end where the longer axis ends. So a round
// footprint is read only at its centre, and one longer than `count` squares is blurred across but has no
// gaps. Sides beyond 1e9 texels or NaN return the coarsest level at the centre.
Fetches fetches_along(const PixelSides& pixel, std::uint32_t width, std::uint32_t height,
                      std::uint32_t count);

// Returns the mean of read(place) over the places; its numbers add and scale one by one. If all places are
// the same, the result is exactly one place's.
template <class Read>
Four mean_over(const Fetches& at, const Read& read) {
  Four mean = read(at.place[0]);
  for (std::uint32_t i = 1; i < at.count; ++i) {
    const Four next = read(at.place[i]);
    for (int n = 0; n < 4; ++n) mean[n] += (next[n] - mean[n]) / float(i + 1);
  }
  return mean;
}

}  // namespace nook::material
