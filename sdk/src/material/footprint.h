// The places of the tile that a pixel reads when it is filtered along the longer side of its footprint.
// shaders/material/footprint.glsl has the same functions.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/relief_tables.h"

namespace nook::material {

inline constexpr std::uint32_t max_fetches = 8;

// The mean over the first `count` places is read; they share one level.
struct Fetches {
  std::uint32_t count = 1;  // 1 to max_fetches
  std::array<ImagePlace, max_fetches> place{};
};

inline Fetches one_fetch(const ImagePlace& place) {
  Fetches at;
  at.place[0] = place;
  return at;
}

// The texture coordinates of a pixel's middle, and their changes from it to the pixel's neighbours to the
// right and above, as dFdx and dFdy give them.
struct PixelSides {
  TexturePlace middle, dx, dy;
};

// Places along the longer axis of the ellipse with the pixel's second moments, in equal steps. Each stands
// for a square of the texture: its side is the ellipse's shorter axis, or what each of `count` has to cover
// of the longer one where that is more, and the outermost squares end where the longer axis does. So a round
// footprint is read at its middle alone, and one that is longer than `count` squares is blurred across, but
// has no gaps. Sides beyond 1e9 texels, or that are no numbers, give the coarsest level at the middle.
Fetches fetches_along(const PixelSides& pixel, std::uint32_t width, std::uint32_t height,
                      std::uint32_t count);

// The mean of read(place) over the places, whose numbers add and scale one by one: exactly that of one place
// where all are the same.
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
