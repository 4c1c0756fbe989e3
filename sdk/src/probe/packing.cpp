#include "sdk/src/probe/packing.h"

#include <algorithm>
#include <cmath>

namespace nook::probe {
namespace {

constexpr int mantissa_bits = 9;
constexpr int exponent_bias = 15;

float in_range(float channel) {
  return channel > 0 ? std::min(channel, max_rgb9e5) : 0.0f;  // 0 also for NaN
}

}  // namespace

std::uint32_t to_rgb9e5(Vec3 rgb) {
  const float channel[3] = {in_range(rgb.x), in_range(rgb.y), in_range(rgb.z)};
  const float largest = std::max({channel[0], channel[1], channel[2]});
  int exponent = -exponent_bias;
  if (largest > 0) std::frexp(largest, &exponent);  // largest = f 2^exponent, f in [1/2, 1)
  exponent = std::max(exponent, -exponent_bias);
  // Rounding may carry the largest mantissa to 512.
  if (std::ldexp(largest, mantissa_bits - exponent) >= 511.5f) ++exponent;
  std::uint32_t bits = std::uint32_t(exponent + exponent_bias) << 27;
  for (int c = 0; c < 3; ++c) {
    const float mantissa = std::ldexp(channel[c], mantissa_bits - exponent);
    bits |= std::uint32_t(mantissa + 0.5f) << (mantissa_bits * c);
  }
  return bits;
}

Vec3 from_rgb9e5(std::uint32_t bits) {
  const float scale = std::ldexp(1.0f, int(bits >> 27) - exponent_bias - mantissa_bits);
  return {float(bits & 511u) * scale, float(bits >> 9 & 511u) * scale, float(bits >> 18 & 511u) * scale};
}

}  // namespace nook::probe
