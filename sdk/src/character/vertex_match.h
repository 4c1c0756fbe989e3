// Which vertex of a model each vertex of a host's mesh is.
//
// Several vertices of a model can lie at one place: where two primitives meet, on the two sides of a card, in
// the layers of hair. A host's vertex is taken for the one that fits best, by these criteria one after
// another:
//   the place; the side that the normal looks to; the weights; the normal; the order of the host's vertices.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/host_vertices.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/memory.h"

namespace nook {

struct VertexMatches {
  // Vertices of the host near none of the model, and the first one of them.
  std::uint32_t unmatched = 0, first_unmatched = no_vertex;
  // Vertices of the host that several vertices of the model with other AO fit equally well, the first one of
  // them, and two vertices of the file that it can be, of which the first was taken.
  std::uint32_t ambiguous = 0, first_ambiguous = no_vertex;
  std::uint32_t taken = no_vertex, other = no_vertex;
};

// Writes the file vertex of each host vertex, or no_vertex. The model has a rest surface and bind data, and
// the primitive is one of its own. The time is linear in the vertices, but for a logarithm and for models
// with many vertices at one place.
VertexMatches match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory);

}  // namespace nook
