// A rigged character as the bakers see it: welded vertices in rest space (metres, after the file's node
// transforms), bones with their rest frames, and the way back to the file's own vertex order.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake {

struct SkinWeights {
  static constexpr int max_bones = 8;
  std::array<std::uint16_t, max_bones> bone{};
  std::array<float, max_bones> weight{};  // non-negative, largest first, sum 1; unused entries are 0

  bool operator==(const SkinWeights&) const = default;
};

struct Bone {
  std::string name;
  std::int32_t parent =
      -1;  // index of the nearest ancestor that is a bone, always smaller than the bone's own; -1: a root
  Mat3x4 frame_rest;  // joint frame (orthonormal axes, origin at the joint) in rest space
};

struct Primitive {
  std::string mesh_name;
  std::uint32_t first_vertex = 0;  // in file order: all primitives in a row
  std::uint32_t vertex_count = 0;
};

struct SkinnedMesh {
  std::vector<Bone> bones;
  std::vector<Vec3> position;                          // welded vertices, rest space, metres
  std::vector<SkinWeights> weights;                    // the same
  std::vector<std::array<std::uint32_t, 3>> triangle;  // indices of welded vertices
  std::vector<std::uint32_t> file_to_welded;
  std::vector<Primitive> primitives;

  std::size_t vertex_count() const { return position.size(); }
};

// One matrix per bone, rest space to world.
using Pose = std::vector<Mat3x4>;

}  // namespace nook::bake
