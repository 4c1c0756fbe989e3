// Stores resampled view maps in few bytes. Most cells mix the same clusters as a neighbour, with coefficients
// close to a prediction from neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/bytes.h"
#include "sdk/src/material/material.h"

namespace nook::material {

// Golomb's and Rice's code of whole numbers, in which small numbers take few bits. A multiple m becomes n = 2
// m, or -2 m - 1 below 0. n is written as n >> k ones, a zero and its k low bits. After 24 ones without a
// zero, n follows in 26 bits.

inline constexpr std::int32_t max_multiple = (1 << 24) - 1;
inline constexpr int k_bits = 5;

// Returns the k for which the multiples take the fewest bits.
std::uint32_t best_k(std::span<const std::int32_t> multiples);
// The magnitude is at most 2 max_multiple.
void write_multiple(ByteWriter& out, std::int32_t multiple, std::uint32_t k);

// Both throw Failure(NOOK_ERROR_BAD_FILE) at a number out of range.
std::uint32_t read_k(ByteReader& in);
std::int32_t read_multiple(ByteReader& in, std::uint32_t k);

// Returns the rows with their terms sorted by cluster.
ViewRows sorted_rows(const ViewRows& rows, const TensorShape& shape, Memory* memory = default_memory());

// Writes the sorted rows: f32 step, two k of the code above, then each cell in packed bits. A cell starts
// with 0 and its clusters, 8 bits each or 16 above 256 clusters. Or it starts with 1 or 2 if it has the
// clusters of the cell before it in its row or in its column. Then its coefficients follow as multiples of
// the step, minus a prediction. The prediction is that cell's multiples. If the two cells before and the
// diagonal one all have the same clusters, it is the sum of the two minus the third. The first k is for cells
// without a prediction.
void write_map_rows(ByteWriter& out, const ViewMap& map, const TensorShape& shape);

// Returns the smallest number of bytes of cells.
constexpr std::size_t min_map_bytes(const TensorShape& shape, std::size_t cells) {
  return (2 * cells + coefficient_count(shape, cells)) / 8;
}
// Reads the rows of map.side. Throws Failure(NOOK_ERROR_BAD_FILE).
void read_map_rows(ByteReader& in, const TensorShape& shape, ViewMap& map);

}  // namespace nook::material
