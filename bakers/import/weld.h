// From vertices in file order to a welded mesh. Vertices split at UV or normal seams become one again, so
// that ambient occlusion agrees across seams. The two sides of a card stay apart, because each has its own
// AO.
#pragma once

#include <nook/nook.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Vertices in file order and rest space; primitives follow each other.
struct FileMesh {
  std::vector<Bone> bones;
  std::vector<Vec3> position;
  std::vector<SkinWeights> weights;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Primitive> primitives;  // empty: one primitive holds everything
  // As the file has them, in the space of each mesh; empty: they equal `position`.
  std::vector<Vec3> mesh_position;
};

// Keeps the max_bones largest weights, adds up entries of the same bone, drops what is not positive, and
// makes the sum 1. Equal sets give equal results in any order. Without a positive weight, the result is all
// zero.
SkinWeights make_weights(std::span<const std::pair<std::uint16_t, float>> influences);

// Arrays as a game has them in memory. Fails with `code`. The limits are the same as in validate().
struct MeshArrays {
  std::vector<Bone> bones;
  std::span<const Vec3> position;        // rest space, metres
  std::span<const std::uint32_t> index;  // three per triangle
  std::size_t influences = 0;            // joints and weights per vertex
  std::span<const std::uint16_t> joint;  // influences * vertices
  std::span<const float> weight;         // the same
  std::vector<Primitive> primitives;
};
FileMesh to_file_mesh(const MeshArrays& arrays, nook_result code);

// Welds vertices with exactly equal rest positions (-0 equals 0) and equal weights, unless their faces have
// opposite normals. Drops degenerate triangles with a warning, and validates the mesh. Fails with `code`. The
// time is linear in vertices and triangles. Places are hashed, and the work at one place is at most the
// square of its corners; 256 of them are looked at.
SkinnedMesh weld(FileMesh mesh, std::vector<std::string>& warnings, nook_result code);

}  // namespace nook::bake
