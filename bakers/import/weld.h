// Makes a welded mesh from vertices in file order. Vertices that were split at UV or normal seams are merged,
// so that ambient occlusion is the same on both sides of a seam. The two sides of a card are not merged,
// because each side has its own AO.
#pragma once

#include <nook/nook.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Vertices in file order, in rest space, one primitive after another.
struct FileMesh {
  std::vector<Bone> bones;
  std::vector<Vec3> position;
  std::vector<SkinWeights> weights;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Primitive> primitives;  // empty: one primitive holds everything
  // The positions as stored in the file, in mesh space. If empty, they are equal to `position`.
  std::vector<Vec3> mesh_position;
};

// Adds up entries of the same bone, drops weights that are not positive, keeps the max_bones largest weights,
// and normalises them to the sum 1. The result does not depend on the order of the entries. If no weight is
// positive, the result is all zero.
SkinWeights make_weights(std::span<const std::pair<std::uint16_t, float>> influences);

// Arrays in the form that a game has them in memory. Fails with `code`. The limits are the same as in
// validate().
struct MeshArrays {
  std::vector<Bone> bones;
  std::span<const Vec3> position;        // rest space, metres
  std::span<const std::uint32_t> index;  // three per triangle
  std::size_t influences = 0;            // joints and weights per vertex
  std::span<const std::uint16_t> joint;  // influences * vertices
  std::span<const float> weight;         // influences * vertices, in the order of `joint`
  std::vector<Primitive> primitives;
};
FileMesh to_file_mesh(const MeshArrays& arrays, nook_result code);

// Welds vertices with exactly equal rest positions (-0 equals 0) and equal weights, unless their faces have
// opposite normals. Drops degenerate triangles with a warning, and validates the mesh. Fails with `code`. The
// time is linear in vertices and triangles, plus the square of the corners at each place. Places with more
// than 256 corners are not examined.
SkinnedMesh weld(FileMesh mesh, std::vector<std::string>& warnings, nook_result code);

}  // namespace nook::bake
