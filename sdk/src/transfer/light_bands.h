// Distant light by its bands 0 to 2: nine real spherical harmonics, orthonormal over the sphere (P.-P. Sloan,
// Stupid Spherical Harmonics Tricks, 2008). Inter-reflections of a shape are smooth, so that these hold the
// light that they need.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::transfer {

inline constexpr std::uint32_t band_count = 9;

constexpr std::array<float, band_count> bands_at(Vec3 d) {
  return {0.2820948f,
          0.4886025f * d.y,
          0.4886025f * d.z,
          0.4886025f * d.x,
          1.0925484f * d.x * d.y,
          1.0925484f * d.y * d.z,
          0.3153916f * (3 * d.z * d.z - 1),
          1.0925484f * d.x * d.z,
          0.5462742f * (d.x * d.x - d.y * d.y)};
}

// Returns the bands of light that lobes of one sharpness hold; amplitudes has axes x RGB.
std::array<Vec3, band_count> bands_of_lobes(std::span<const Vec3> axes, float sharpness,
                                            std::span<const float> amplitudes);

}  // namespace nook::transfer
