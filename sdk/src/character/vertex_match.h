// Which vertex of a model each vertex of a host's mesh is.
//
// Several vertices of a model can lie at one place: where two primitives meet, on the two sides of a card, in
// the layers of hair. The best fit wins. These criteria decide, one after another:
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
  // Counts the host's vertices that are near no vertex of the model.
  std::uint32_t unmatched = 0, first_unmatched = no_vertex;
  // Counts the host's vertices that fit several vertices of the model with other AO.
  std::uint32_t ambiguous = 0, first_ambiguous = no_vertex;
  // The file vertices that the first ambiguous vertex can be.
  std::uint32_t taken = no_vertex, other = no_vertex;
};

// Writes the file vertex of each host vertex, or no_vertex. The model must have a rest surface and bind data,
// and the primitive must belong to it. The time is linear in the vertices, but for a logarithm and for models
// with many vertices at one place.
VertexMatches match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory);

}  // namespace nook
