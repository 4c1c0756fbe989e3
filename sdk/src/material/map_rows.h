// Resampled view maps in few bytes: most cells mix the same clusters as a neighbour, with coefficients close
// to those that their neighbours predict.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"
#include "sdk/src/material/material.h"

namespace nook::material {

// Golomb's and Rice's code of whole numbers, for which small ones take few bits. A multiple m becomes n = 2
// m, or -2 m - 1 below 0, and n becomes n >> k ones, a zero and its k low bits; after 24 ones without a zero
// n follows in 26 bits.

inline constexpr std::int32_t max_multiple = (1 << 24) - 1;
inline constexpr int k_bits = 5;

// Returns the k for which the multiples take the fewest bits.
std::uint32_t best_k(std::span<const std::int32_t> multiples);
// The magnitude is at most 2 max_multiple.
void write_multiple(ByteWriter& out, std::int32_t multiple, std::uint32_t k);

// Both throw Failure(NOOK_ERROR_BAD_FILE) at a number out of range.
std::uint32_t read_k(ByteReader& in);
std::int32_t read_multiple(ByteReader& in, std::uint32_t k);

// Returns rows whose terms are in the order of their clusters.
ViewRows sorted_rows(const ViewRows& rows, const TensorShape& shape, Memory* memory = default_memory());

// Writes the rows, sorted: f32 step, two k of the code above, and for each cell in packed bits: 0 and its
// clusters, 8 bits each, or 16 above 256 clusters; or 1 if it has those of the cell before it in its row; or
// 2 if it has those of the cell before it in its column. Then follow its coefficients as multiples of the
// step, less a prediction: the multiples of that cell, or, if the two cells before it and the one before both
// have the same clusters, the sum of the two less the third. The first k is that of cells without a
// prediction.
void write_map_rows(ByteWriter& out, const ViewMap& map, const TensorShape& shape);

// Returns the smallest number of bytes of cells.
constexpr std::size_t min_map_bytes(const TensorShape& shape, std::size_t cells) {
  return (2 * cells + coefficient_count(shape, cells)) / 8;
}
// Reads the rows of map.side. Throws Failure(NOOK_ERROR_BAD_FILE).
void read_map_rows(ByteReader& in, const TensorShape& shape, ViewMap& map);

}  // namespace nook::material
