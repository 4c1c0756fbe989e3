// Floats in the smallest of a few forms that holds each of them exactly: the numbers of a texture come from
// few bits, and every number comes back with the same bits.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"
#include "sdk/src/core/containers.h"

namespace nook::nnao {

enum class ExactPacking : std::uint8_t {
  float32 = 0,
  half = 1,
  unorm8 = 2,   // v = float(u) / 255
  unorm16 = 3,  // v = float(u) / 65535
};
inline constexpr std::uint32_t exact_packing_count = 4;

std::size_t packed_bytes(ExactPacking packing);

// The smallest form that holds all values; of two of the same size, the first.
ExactPacking exact_packing(std::span<const float> values);

// Writes the packing as one byte, and the values.
void write_exact(ByteWriter& out, std::span<const float> values);

// Reads what write_exact wrote, to the end of the section, into `values`, which gets `count` numbers. Throws
// Failure(NOOK_ERROR_BAD_FILE) before anything is allocated if the section has another size.
void read_exact(ByteReader in, std::uint32_t count, Vector<float>& values);

}  // namespace nook::nnao
