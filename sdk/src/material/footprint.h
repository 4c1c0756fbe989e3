// Anisotropic filtering. Finds the places of the tile at which a pixel reads the material. The places lie
// along the longer axis of the pixel's footprint. shaders/material/footprint.glsl has the same functions.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/relief_tables.h"

namespace nook::material {

inline constexpr std::uint32_t max_fetches = 8;

// The pixel's value is the mean over the first `count` places. All places have the same mipmap level.
struct Fetches {
  std::uint32_t count = 1;  // 1 to max_fetches
  std::array<ImagePlace, max_fetches> place{};
};

inline Fetches one_fetch(const ImagePlace& place) {
  Fetches at;
  at.place[0] = place;
  return at;
}

// The texture coordinates of a pixel's centre, and their derivatives along x and y as dFdx and dFdy return
// them.
struct PixelSides {
  TexturePlace middle, dx, dy;
};

// Approximates the pixel's footprint by an ellipse with the same second moments, and covers the ellipse with
// up to `count` squares. Returns the centres of the squares, at equal steps along the longer axis. The
// outermost squares end at the ends of the longer axis. So a round footprint has only one square, at its
// centre. The side of a square is the shorter axis, or longer if `count` such squares would leave gaps. A
// footprint that is too long for `count` squares is blurred across the longer axis, but has no gaps. If a
// derivative is NaN or above 1e9 texels, the result is one place, at the centre, in the coarsest level.
Fetches fetches_along(const PixelSides& pixel, std::uint32_t width, std::uint32_t height,
                      std::uint32_t count);

// Returns the mean of read(place) over all places. If all places are the same, the result is exactly the
// value of one place.
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
