// Imports a static textured shape from a glTF 2.0 file: the triangles of its default scene. Each vertex has a
// normal, a tangent and texture coordinates, in the file's own vertex order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/import/texture_use.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// A tangent of unit length across the normal, along growing u. handedness * cross(normal, direction) points
// along growing v.
struct Tangent {
  Vec3 direction;
  float handedness = 1;
};

// World space, metres. Vertices follow each other node by node and primitive by primitive in the file's
// order; a mesh that two nodes or instances show appears twice.
struct SurfaceMesh {
  std::vector<Vec3> position, normal;
  std::vector<Tangent> tangent;
  std::vector<TexturePoint> uv;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

struct ImportedSurface {
  SurfaceMesh mesh;
  std::vector<std::string> warnings;  // what was made or repaired, one sentence each
};

// Ignores skins, and gives morph targets their default weights. Makes normals by vertex_normals where a
// primitive has no NORMAL or is morphed. Makes tangents by surface_tangents where a primitive lacks TANGENT,
// or its normals are made. Fails with BAD_FILE, also where a primitive has no TEXCOORD_0; the message names
// the fault, and the caller adds the name of the file.
ImportedSurface import_surface(const std::filesystem::path& path, const ImportOptions& options = {});

// Imports from memory, without access to any file: buffers must be in the bytes or in data URIs.
ImportedSurface import_surface(std::span<const std::byte> bytes, const MeshSelection& meshes = {});

// Makes normals and tangents for vertices without them.

// Returns normals weighted by area and averaged over vertices at exactly the same position. A vertex without
// a triangle of positive area gets +z.
std::vector<Vec3> smooth_normals(std::span<const Vec3> position,
                                 std::span<const std::array<std::uint32_t, 3>> triangle);

// Returns tangents by the rule of M. Mikkelsen's tangent space (Simulation of Wrinkled Surfaces Revisited,
// 2008), in an implementation of our own. The tangent of a triangle at a corner is the direction of growing u
// in its plane, projected across the vertex's normal and normalised. A vertex takes the mean over all
// vertices with equal position, normal and texture coordinates, weighted by the corners' angles. Only
// triangles with its own handedness count. A vertex shared by triangles of both takes the handedness with the
// larger sum of angles. Triangles do not count if their area, or their area in texture coordinates, is not
// above 0. A vertex without others gets an arbitrary tangent across its normal. Adds a sentence to warnings
// for each kind of repair.
std::vector<Tangent> surface_tangents(const SurfaceMesh& mesh, std::vector<std::string>& warnings);

// Returns the tangent across a unit normal that is nearest to a direction. If the direction is along the
// normal, the tangent is arbitrary.
Vec3 across_normal(Vec3 normal, Vec3 direction);

}  // namespace nook::bake
