// Coefficients in fewer bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook::probe {

enum class Packing : std::uint8_t { float32 = 0, half = 1, rgb9e5 = 2 };

constexpr std::size_t packed_bytes(Packing packing) {
  return packing == Packing::float32 ? 12 : packing == Packing::half ? 6 : 4;
}

inline constexpr float max_half = 65504.0f;
inline constexpr float max_rgb9e5 = 65408.0f;  // 511 / 512 * 2^16

// Three mantissas of 9 bits, red lowest, and one exponent of 5 above them: GL_RGB9_E5. Channels are clamped
// to [0, max_rgb9e5], NaN to 0. The error of each channel is at most 2^-9 of the largest one, 2^-25 where
// that is below 2^-15.
std::uint32_t to_rgb9e5(Vec3 rgb);
Vec3 from_rgb9e5(std::uint32_t bits);

}  // namespace nook::probe
