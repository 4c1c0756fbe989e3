// Compresses resampled view maps. Most cells mix the same clusters as a neighbouring cell, and their
// coefficients can be predicted well from neighbouring cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"
#include "sdk/src/material/material.h"

namespace nook::material {

// Golomb-Rice coding of integers, in which small magnitudes take few bits. A multiple m is mapped to n = 2 m,
// or to n = -2 m - 1 if m is negative. n is written as n >> k ones, a zero, and the k low bits of n. If n >>
// k is 24 or more, 24 ones are written, followed by n in 26 bits.

inline constexpr std::int32_t max_multiple = (1 << 24) - 1;
inline constexpr int k_bits = 5;

// Returns the k for which the multiples take the fewest bits.
std::uint32_t best_k(std::span<const std::int32_t> multiples);
// The magnitude of `multiple` must be at most 2 max_multiple.
void write_multiple(ByteWriter& out, std::int32_t multiple, std::uint32_t k);

// Both functions throw Failure(NOOK_ERROR_BAD_FILE) if the value is out of range.
std::uint32_t read_k(ByteReader& in);
std::int32_t read_multiple(ByteReader& in, std::uint32_t k);

// Returns a copy of the rows, with the terms of each row sorted by cluster.
ViewRows sorted_rows(const ViewRows& rows, const TensorShape& shape, Memory* memory = default_memory());

// Writes sorted rows: the step as f32, two values of k, and then each cell in packed bits. A cell starts with
// a code for its clusters. Code 0 means that the cluster indices follow, with 8 bits each, or 16 bits if
// there are more than 256 clusters. Code 1 means that the cell has the same clusters as the previous cell in
// its row. Code 2 means that it has the same clusters as the previous cell in its column. Then the
// coefficients follow as multiples of the step. From each multiple, a prediction is subtracted. The
// prediction is the multiple of the previous cell that has the same clusters. If the previous cells in the
// row, in the column and on the diagonal all have the same clusters as this cell, the prediction is row +
// column - diagonal. The first k is for cells without a prediction, the second for all others.
void write_map_rows(ByteWriter& out, const ViewMap& map, const TensorShape& shape);

// Returns the minimum number of bytes that this many cells can take in a file.
constexpr std::size_t min_map_bytes(const TensorShape& shape, std::size_t cells) {
  return (2 * cells + coefficient_count(shape, cells)) / 8;
}
// Reads the rows of a map whose `side` is already set. Throws Failure(NOOK_ERROR_BAD_FILE).
void read_map_rows(ByteReader& in, const TensorShape& shape, ViewMap& map);

}  // namespace nook::material
