// A rigged character in the form that the bakers use. It has welded vertices in rest space (metres, after the
// file's node transforms) and bones with their rest frames. It also maps welded vertices to the vertex order
// of the file.
#pragma once

#include <nook/nook.h>

#include <array>
#include <cstdint>
#include <span>
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
      -1;             // index of the nearest ancestor bone, always smaller than the bone's own; -1: a root
  Mat3x4 frame_rest;  // joint frame (orthonormal axes, origin at the joint) in rest space
};

struct Primitive {
  std::string mesh_name;
  std::uint32_t first_vertex = 0;  // index of a vertex in file order, counted over all primitives
  std::uint32_t vertex_count = 0;
};

struct SkinnedMesh {
  std::vector<Bone> bones;
  std::vector<Vec3> position;                          // welded vertices, rest space, metres
  std::vector<SkinWeights> weights;                    // one entry per welded vertex
  std::vector<std::array<std::uint32_t, 3>> triangle;  // indices of welded vertices
  std::vector<std::uint32_t> file_to_welded;
  std::vector<Primitive> primitives;

  std::size_t vertex_count() const { return position.size(); }
};

// One matrix per bone, rest space to world.
using Pose = std::vector<Mat3x4>;

// Posed positions, normals and areas of welded vertices.

// Computes linear blend skinning. Resizes `out_ws` to the number of vertices. Reuse it between poses, to
// avoid allocations.
void skin_positions(const SkinnedMesh& mesh, const Pose& pose, std::vector<Vec3>& out_ws);

// Returns area-weighted unit normals. If the normals of the faces around a vertex add up to zero, the vertex
// gets the normal of one of these faces. It gets +y if all its faces are degenerate, or if it has no face.
void vertex_normals(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> positions,
                    std::vector<Vec3>& out);

// Mixed Voronoi area of each vertex (Meyer, Desbrun, Schroeder, Barr 2003, "Discrete Differential-Geometry
// Operators for Triangulated 2-Manifolds", section 3.3). The sum over all vertices is the area of the
// surface.
std::vector<float> vertex_areas(const SkinnedMesh& mesh, std::span<const Vec3> positions);

// Checks a mesh before a bake, for meshes from files and from memory.

struct FileMesh;

constexpr std::size_t max_bone_count = 65535;  // bone indices are 16 bits
constexpr std::size_t max_file_vertices =
    10'000'000;  // far above any character; limits the memory for malicious files

// Checks that there are 1 to max_bone_count bones, parents before children, with finite orthonormal frames.
// Positions must be finite. Weights must be finite, non-negative, with sum 1. Bones and indices must be in
// range. The primitives must cover all vertices in order and without gaps. There must be at least one
// triangle. Fails with `code`. The message contains the first fault and the number of faults.
void validate(const FileMesh& mesh, nook_result code = NOOK_ERROR_INVALID_ARGUMENT);
void validate(const SkinnedMesh& mesh, nook_result code = NOOK_ERROR_INVALID_ARGUMENT);

}  // namespace nook::bake
