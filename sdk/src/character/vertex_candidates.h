// A host's vertices, and the vertices of a model that they can be compared with, in the host's space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/character/model.h"
#include "sdk/src/core/memory.h"

namespace nook {

// Three floats for each vertex, `stride` bytes apart.
struct StridedPoints {
  const float* first = nullptr;
  std::size_t stride = 12;

  Vec3 operator[](std::size_t index) const;
};

struct HostVertices {
  std::uint32_t count = 0;
  StridedPoints position;
  StridedPoints normal;  // first null: none
  bool in_rest_space = false;
  std::int32_t primitive = -1;  // of the file; -1: all
  float tolerance = 1e-4f;      // share of the diagonal of the model's box
};

// The space of the mesh that a vertex of the file belongs to, an index into BindData::rest_from_mesh. The
// model has bind data.
std::uint16_t space_of(const CharacterModel& model, std::uint32_t file_vertex);

// A vertex of the model that a host's vertex can be, in the host's space.
struct Candidate {
  Vec3 position;
  Vec3 normal;
  std::uint32_t file_vertex = 0;
};
using Candidates = Vector<Candidate>;

// The file vertices of the primitives that the host names, in file order. The model has a rest surface and
// bind data.
Candidates candidates_of(const CharacterModel& model, const HostVertices& host, Memory* memory);

// HostVertices::tolerance as a length in the host's unit.
float tolerance_of(const CharacterModel& model, const HostVertices& host);

// Sets the primitives of `out` and their spaces, where vertex i of `out` belongs to the mesh of
// file_vertices[i] of `model`: runs of vertices of the same space.
void set_primitives(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                    CharacterModel& out);

}  // namespace nook
