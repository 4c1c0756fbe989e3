// Converts floats to bits, half floats and shader text, with the same result on every machine.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace nook {

template <typename To, typename From>
To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  To to;
  std::memcpy(&to, &from, sizeof to);
  return to;
}

// Converts to IEEE half floats by integer arithmetic, with the same bits on every machine.

// Rounds to the nearest half, ties to even. Values beyond 65504 become infinity.
inline std::uint16_t to_half(float value) {
  const std::uint32_t bits = bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return std::uint16_t(sign | 0x7e00u);
  if (magnitude >= 0x47800000u) return std::uint16_t(sign | 0x7c00u);
  if (magnitude < 0x33000000u) return std::uint16_t(sign);
  const std::uint32_t exponent = magnitude >> 23;
  std::uint32_t mantissa = magnitude, dropped = 13;
  if (exponent >= 113) {
    mantissa -= 112u << 23;
  } else {
    mantissa = (magnitude & 0x7fffffu) | 0x800000u;
    dropped = 126 - exponent;
  }
  const std::uint32_t kept = mantissa >> dropped, rest = mantissa & ((1u << dropped) - 1),
                      half = 1u << (dropped - 1);
  return std::uint16_t(sign | (kept + (rest > half || (rest == half && (kept & 1u)))));
}

inline float from_half(std::uint16_t half) {
  const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16, magnitude = half & 0x7fffu;
  if (magnitude >= 0x7c00u) return bit_cast<float>(sign | 0x7f800000u | (magnitude & 0x3ffu) << 13);
  if (magnitude >= 0x400u) return bit_cast<float>(sign | ((magnitude << 13) + (112u << 23)));
  const float value = float(magnitude) * 0x1p-24f;
  return sign ? -value : value;
}

// The functions below write floats into the text of shaders.

// The text of a float. It has room for the longest text, -1.17549435e-38, and its terminating zero.
struct FloatLiteral {
  char text[16];
};

// Returns the shortest GLSL literal that reads back as the same float, such as 1.5e-01, in the scientific
// format of std::to_chars. std::to_chars itself is not used, because libc++ 13 does not have it for floats.
// printf is not used, because it writes the decimal separator of the host's locale. The value must be finite.
FloatLiteral float_literal(float value);

}  // namespace nook
