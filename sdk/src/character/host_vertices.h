// Adapts a model to a host's mesh. Reorders the model to the order of the host's vertices, or resamples the
// model for another mesh of the same body. vertex_match.h finds the matching vertices.
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

// Joints and weights of each vertex, `joint_stride` and `weight_stride` bytes apart.
struct HostWeights {
  const std::uint16_t* joint = nullptr;  // null: none
  const float* weight = nullptr;         // finite, 0 or more
  std::size_t joint_stride = 0, weight_stride = 0;
  std::uint32_t influences = 0;
  // The bone of each joint. It must cover every joint that has a weight. If empty, the joint indices are bone
  // indices.
  std::span<const std::uint16_t> bone_of_joint;

  std::uint16_t joint_at(std::size_t vertex, std::uint32_t influence) const;
  float weight_at(std::size_t vertex, std::uint32_t influence) const;
};

struct HostVertices {
  std::uint32_t count = 0;
  StridedPoints position;
  StridedPoints normal;       // no normals if `first` is null
  StridedPoints face_normal;  // mean normal of the triangles around each vertex, unit length or 0; no normals
                              // if `first` is null
  HostWeights weights;
  bool in_rest_space = false;
  std::int32_t primitive = -1;  // index of a primitive of the file; -1: all primitives
  float tolerance = 1e-4f;      // relative to the diagonal of the model's bounding box
};

// Returns the space of the mesh that a file vertex belongs to, as an index into BindData::rest_from_mesh. The
// model must have bind data.
std::uint16_t space_of(const CharacterModel& model, std::uint32_t file_vertex);

// A model vertex that may match a host vertex, given in the host's space.
struct Candidate {
  Vec3 position;
  Vec3 normal;
  std::uint32_t file_vertex = 0;  // the first file vertex of the welded vertex that is in this space
  std::uint32_t welded = 0;
  std::uint16_t space = 0;
  const BoneWeights* weights =
      nullptr;  // null: the model stores no weights, because all nearby vertices have the same weights
};
using Candidates = Vector<Candidate>;

// Returns the welded vertices of the primitives that the host selects, in file order. A welded vertex is
// returned once for each space. The model must have a rest surface and bind data, and must outlive the
// result.
Candidates candidates_of(const CharacterModel& model, const HostVertices& host, Memory* memory);

// Returns the diagonal of the bounding box of the model's rest pose, in the host's unit.
float diagonal_of(const CharacterModel& model, const HostVertices& host);

// Returns HostVertices::tolerance as a length in the host's unit.
float tolerance_of(const CharacterModel& model, const HostVertices& host);

// Sets the primitives of `out` and their spaces. Each primitive is a range of consecutive vertices in the
// same space. Vertex i of `out` belongs to the same mesh as the vertex file_vertices[i] of `model`.
void set_primitives(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                    CharacterModel& out);

inline constexpr std::uint32_t no_vertex = UINT32_MAX;

// Returns the model with file_vertices[i] as its vertex i. Every index must be in range.
CharacterModel remapped(const CharacterModel& model, std::span<const std::uint32_t> file_vertices,
                        Memory* memory);

// The vertex of a host's mesh that lies farthest from the model. It shows whether the mesh is the same body,
// for example at another level of detail.

struct FarVertex {
  std::uint32_t vertex = 0;  // index of the host vertex
  float distance = 0;        // distance to the nearest model vertex that faces the same way, in the host's
                             // unit
};

// Returns the host vertex that is farthest from all model vertices. The model must have a rest surface and
// bind data, and the host at least one vertex.
FarVertex farthest_vertex(const CharacterModel& model, const HostVertices& host, Memory* memory);

// Returns a model with one welded vertex for each vertex of the host. A host vertex takes the mean weights of
// the three nearest baked vertices that face the same way. This gives the mean of their AO in every pose,
// because the linear layer is linear in its weights. Only the largest CharacterModel::max_influences weights
// are kept. They are scaled so that the sum of the weights stays the same.
CharacterModel resampled(const CharacterModel& model, const HostVertices& host, Memory* memory);

}  // namespace nook
