// A host's vertices and those of a model: which is which, and a model in the host's order.
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

inline constexpr std::uint32_t no_vertex = UINT32_MAX;

// Writes the file vertex of each host vertex, or no_vertex, and returns the number of no_vertex. The model
// has a rest surface and bind data, and the primitive is one of its own.
std::uint32_t match_vertices(const CharacterModel& model, const HostVertices& host,
                             std::span<std::uint32_t> file_vertices, Memory* memory);

// The model with file_vertices[i] as its vertex i. Every index is in range.
CharacterModel remapped(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                        Memory* memory);

}  // namespace nook
