// Which vertices of the linear layer share a block: near ones, because those share key points, so that a
// block has few columns.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "sdk/src/character/model.h"

namespace nook {

// All vertices in the order of their slots, by halving the longest side of their bounding box until a block
// is left; a vertex is where its key points are on average, in space and in direction. The model's influences
// must be valid.
std::pmr::vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                                   std::pmr::memory_resource* memory);

}  // namespace nook
