// A host's vertices and those of a model: which is which, and a model in the host's order.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/model.h"
#include "sdk/src/character/vertex_candidates.h"
#include "sdk/src/core/memory.h"

namespace nook {

inline constexpr std::uint32_t no_vertex = UINT32_MAX;

// Writes the file vertex of each host vertex, or no_vertex, and returns the number of no_vertex. The model
// has a rest surface and bind data, and the primitive is one of its own.
std::uint32_t match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory);

// The model with file_vertices[i] as its vertex i. Every index is in range.
CharacterModel remapped(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                        Memory* memory);

}  // namespace nook
