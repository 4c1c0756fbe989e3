#include "sdk/src/material/packed_numbers.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/half.h"

namespace nook::material {
namespace {

// The largest magnitude becomes a number in [2^14, 2^15); after rounding up it is still below a half's 65504.
constexpr int top_exponent = 14;
constexpr int max_exponent = 100;

}  // namespace

void write_packed(ByteWriter& out, std::span<const float> values) {
  float largest = 0;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  const int exponent =
      largest > 0 ? std::clamp(std::ilogb(largest) - top_exponent, -max_exponent, max_exponent) : 0;
  out.u8(static_cast<std::uint8_t>(exponent));
  for (const float value : values) out.u16(to_half(std::ldexp(value, -exponent)));
}

void read_packed(ByteReader& in, std::span<float> values) {
  const int exponent = static_cast<std::int8_t>(in.u8());
  if (std::abs(exponent) > max_exponent)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s holds an exponent out of range (got %d, need -%d to %d); bake the file again",
                  in.name(), exponent, max_exponent, max_exponent);
  for (float& value : values) {
    value = std::ldexp(from_half(std::uint16_t(in.u16())), exponent);
    if (!std::isfinite(value))
      throw Failure(NOOK_ERROR_BAD_FILE, "section %s holds a number that is not finite; bake the file again",
                    in.name());
  }
}

}  // namespace nook::material
