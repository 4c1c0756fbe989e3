// Golomb's and Rice's code of whole numbers, for which small ones take few bits. A multiple m becomes n = 2
// m, or -2 m - 1 below 0, and n becomes n >> k ones, a zero and its k low bits; after 24 ones without a zero
// n follows in 26 bits.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"

namespace nook::material {

inline constexpr std::int32_t max_multiple = (1 << 24) - 1;
inline constexpr int k_bits = 5;

// Returns the k for which the multiples take the fewest bits.
std::uint32_t best_k(std::span<const std::int32_t> multiples);
// The magnitude is at most 2 max_multiple.
void write_multiple(ByteWriter& out, std::int32_t multiple, std::uint32_t k);

// Both throw Failure(NOOK_ERROR_BAD_FILE) at a number out of range.
std::uint32_t read_k(ByteReader& in);
std::int32_t read_multiple(ByteReader& in, std::uint32_t k);

}  // namespace nook::material
