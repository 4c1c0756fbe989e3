// Resampled view maps in few bytes: most cells mix the same clusters as a neighbour, with coefficients close
// to those that their neighbours predict.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sdk/src/core/bytes.h"
#include "sdk/src/material/material.h"

namespace nook::material {

// Returns rows whose terms are in the order of their clusters.
ViewRows sorted_rows(const ViewRows& rows, const TensorShape& shape, Memory* memory = default_memory());

// Writes the rows, sorted: f32 step, two k of rice_code.h, and for each cell in packed bits: 0 and its
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
