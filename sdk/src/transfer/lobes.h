// The lobes that hold distant light: spherical Gaussians exp(sharpness (dot(axis, s) - 1)) of one sharpness,
// evenly spread over the sphere. Their number determines all of them.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::transfer {

inline constexpr std::uint32_t min_lobes = 12;
// The largest number of the paper's Table II, whose factored Gram matrix has 25 MiB.
inline constexpr std::uint32_t max_lobes = 2562;

// Between sharpnesses of 0.2 and 0.5 times the number, wider lobes hold suns better and broad light worse;
// 0.35 is the best compromise over made maps of a sun, of windows and of clouds (docs/transfer.md).
constexpr float sharpness_of(std::uint32_t lobes) {
  return 0.35f * float(lobes);
}

// H. Vogel's spiral: the azimuths are apart by the golden angle, and the heights z run from 1 to -1 at the
// centres of equal areas.
void lobe_axes(std::span<Vec3> axes);

}  // namespace nook::transfer
