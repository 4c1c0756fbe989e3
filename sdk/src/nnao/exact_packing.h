// Packs an array of floats losslessly, in the smallest of a few number formats that represents every value
// exactly. Texels then take few bits, and unpacking returns bit-identical floats.
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

  // Returns the bytes per value: 2 for half floats, otherwise `bits` rounded up to whole bytes.
  constexpr std::size_t bytes() const { return (std::size_t(bits) + 7) / 8; }
  bool operator==(const ExactPacking&) const = default;
};
inline constexpr ExactPacking packed_as_floats{32}, packed_as_halves{15};

// Returns the smallest format that holds all values exactly.
ExactPacking exact_packing(std::span<const float> values);

// Writes one byte with `bits`, one byte with the normalisation, and then the values.
void write_exact(ByteWriter& out, std::span<const float> values);

// Reads the output of write_exact up to the end of the section, and resizes `values` to `count`. If the
// section's size does not match, it throws Failure(NOOK_ERROR_BAD_FILE) before it allocates anything.
void read_exact(ByteReader in, std::uint32_t count, Vector<float>& values);

}  // namespace nook::nnao
