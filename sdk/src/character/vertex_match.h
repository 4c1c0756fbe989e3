// Finds the matching model vertex for each vertex of a host's mesh.
//
// Several vertices of a model can lie at one place: where two primitives meet, on the two sides of a card, or
// in layers of hair. The function then chooses the best match. The criteria, the most important first, are:
//   place, equal weights, side of the triangles or of the normal, near weights, normal, order of the host's
//   vertices.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/host_vertices.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/memory.h"

namespace nook {

struct VertexMatches {
  // Counts the host vertices that have no model vertex nearby. The first of them is first_unmatched.
  std::uint32_t unmatched = 0, first_unmatched = no_vertex;
  // Counts the host vertices that fit several model vertices with different AO. The first of them is
  // first_ambiguous.
  std::uint32_t ambiguous = 0, first_ambiguous = no_vertex;
  // Two file vertices that both match the first ambiguous vertex: `taken` was chosen, and `other` was not.
  std::uint32_t taken = no_vertex, other = no_vertex;
};

// Writes the file vertex of each host vertex, or no_vertex. The model must have a rest surface and bind data,
// and host.primitive must be one of its primitives, or -1. The running time is about O(n log n) for n
// vertices, and longer for models with many vertices at one place.
VertexMatches match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory);

}  // namespace nook
