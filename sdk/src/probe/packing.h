// Coefficients in fewer bits.
#pragma once

#include <cstdint>

#include "core/vec.h"

namespace nook::probe {

enum class Packing : std::uint8_t { float32 = 0, half = 1, rgb9e5 = 2 };

inline constexpr float max_rgb9e5 = 65408.0f;  // 511 / 512 * 2^16

// Shared exponent: three mantissas of 9 bits, red lowest, one exponent of 5 above
// (EXT_texture_shared_exponent, GL_RGB9_E5). Channels are clamped to [0, max_rgb9e5]; NaN becomes 0. The
// error of a channel is at most half a step, 2^-10 of the largest channel's power of two, where that is 2^-15
// or more.
std::uint32_t to_rgb9e5(Vec3 rgb);
Vec3 from_rgb9e5(std::uint32_t bits);

}  // namespace nook::probe
