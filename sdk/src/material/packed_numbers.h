// Floats as half floats with one common exponent, so that the largest of them lies near a half's maximum and
// small ones keep their precision.
#pragma once

#include <cstddef>
#include <span>

#include "sdk/src/core/bytes.h"

namespace nook::material {

// All values must be finite.
void write_packed(ByteWriter& out, std::span<const float> values);

constexpr std::size_t packed_bytes(std::size_t count) {
  return 1 + 2 * count;
}
// Throws Failure(NOOK_ERROR_BAD_FILE) at a number that is not finite.
void read_packed(ByteReader& in, std::span<float> values);

}  // namespace nook::material
