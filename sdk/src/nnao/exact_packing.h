// Stores floats in the smallest of a few forms that holds each of them exactly. Texels need few bits this
// way, and every number comes back with the same bits.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"
#include "sdk/src/core/containers.h"

namespace nook::nnao {

// How a driver turns an integer of a normalised format into a float.
enum class Normalisation : std::uint8_t {
  division = 0,      // float(u) / largest
  product = 1,       // float(u) * (1.0f / largest)
  wide_product = 2,  // float(double(u) * (1.0 / largest))
};

struct ExactPacking {
  std::uint8_t bits = 32;  // 32: floats; 8, 10, 16, 24: normalised integers; 15: half floats
  Normalisation normalisation = Normalisation::division;

  // How many bytes a value takes: 4, 2 for half floats, else its bits rounded up.
  constexpr std::size_t bytes() const { return (std::size_t(bits) + 7) / 8; }
  bool operator==(const ExactPacking&) const = default;
};
inline constexpr ExactPacking packed_as_floats{32}, packed_as_halves{15};

// The smallest form that holds all values.
ExactPacking exact_packing(std::span<const float> values);

// Writes two bytes, the bits and the normalisation, and the values.
void write_exact(ByteWriter& out, std::span<const float> values);

// Reads what write_exact wrote, to the end of the section, into `values`, which gets `count` numbers. Throws
// Failure(NOOK_ERROR_BAD_FILE) before it allocates anything if the section has another size.
void read_exact(ByteReader in, std::uint32_t count, Vector<float>& values);

}  // namespace nook::nnao
