// Bind data describes the rest pose of the rigged file from which a model was baked. The joint matrices and
// skinning matrices of engines do not use this library's rest space. So the bind data is used to convert the
// engine's matrices (pose_source.h), to compare the host's skinned vertices with the model's (pose_check.h),
// and to find the model's vertices in a host's mesh (host_vertices.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

struct BoneBind {
  // Maps rest space to the joint's own space. The matrix of the bone is joint_to_world * node_from_rest.
  Mat3x4 node_from_rest;
  // The first bone of the same joint. A joint has several bones if several skins bind it differently.
  std::uint16_t first_of_joint = 0;
};

struct SkinBind {
  std::uint32_t file_index = 0;                    // index of the skin in the file
  std::uint16_t space = 0;                         // index into BindData::rest_from_mesh
  std::uint32_t first_joint = 0, joint_count = 0;  // range of BindData::bone_of_joint, in the skin's order
};

// The bones that move a vertex.
struct BoneWeights {
  static constexpr std::uint32_t max_bones = 8;
  std::uint32_t count = 0;
  std::array<std::uint16_t, max_bones> bone{};
  std::array<float, max_bones> weight{};  // the first `count` entries are between 0 and 1, and sum to 1
};

// A welded vertex that is so close to another one that the quantised rest positions of both may be equal.
struct CloseVertex {
  std::uint32_t welded = 0;
  std::uint16_t space = 0;  // index into BindData::rest_from_mesh
  Vec3 mesh_position;       // in the space `space`, bit-exact as in the file
  BoneWeights weights;      // no weights if all nearby vertices have the same weights
};

// A vertex of the file, with all data that is needed to skin it.
struct RestVertex {
  static constexpr std::uint32_t max_bones = 8;
  std::uint32_t file_vertex = 0;
  Vec3 position;  // rest space, metres
  std::uint32_t bone_count = 0;
  std::array<std::uint16_t, max_bones> bone{};
  std::array<float, max_bones> weight{};  // the first bone_count entries are above 0 and sum to 1
};

struct BindData {
  explicit BindData(Memory* memory = default_memory())
      : bones(memory),
        rest_from_mesh(memory),
        primitive_space(memory),
        skins(memory),
        bone_of_joint(memory),
        vertices(memory),
        close(memory) {}

  static constexpr std::uint32_t max_vertices = 64;

  Vector<BoneBind> bones;  // one for each bone; empty: the model has no bind data
  // The distinct matrices in the file that map the space of a mesh's POSITION attribute to rest space.
  Vector<Mat3x4> rest_from_mesh;
  Vector<std::uint16_t> primitive_space;  // index into rest_from_mesh, for each primitive
  Vector<SkinBind> skins;                 // empty: the meshes are rigid, or came as arrays
  Vector<std::uint16_t> bone_of_joint;    // the bones of all skins, one skin after another
  Vector<RestVertex> vertices;            // a sample of at most max_vertices file vertices, chosen so that it
                                          // covers the bones
  Vector<CloseVertex> close;              // vertices that are near each other are stored next to each other

  bool empty() const { return bones.empty(); }
};

// Rest positions and normals of the welded vertices; both may be empty.
struct RestSurface {
  explicit RestSurface(Memory* memory = default_memory()) : position(memory), normal(memory) {}

  Vector<Vec3> position;  // rest space, metres
  Vector<Vec3> normal;    // unit length
};

}  // namespace nook
