// The order of vertices in the linear layer. Vertices of a block share key points, so that a block has few
// columns, and blocks follow the file, so that AO is written to memory that is near.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/containers.h"

namespace nook {

// A multiple of all block sizes. Its AO lies in 4 KiB where the file has no other vertices between.
inline constexpr std::uint32_t linear_window_vertices = 1024;

// Returns all vertices in the order of their slots. Blocks are made of the vertices of one window of the
// file's order: the first that is left, then always the one that needs the fewest further key points. The
// model's influences must be valid.
Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory);

}  // namespace nook
