// The order of vertices in the linear layer. Vertices of a block are near each other, because near vertices
// share key points, so that a block has few columns.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/containers.h"

namespace nook {

// Returns all vertices in the order of their slots, by halving the longest side of their bounding box until
// each part is one block. The place of a vertex is the weighted mean of its key points, in position and
// direction. The model's influences must be valid.
Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory);

}  // namespace nook
