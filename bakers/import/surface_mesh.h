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

// A tangent of unit length, perpendicular to the normal. It points in the direction in which u increases.
// handedness * cross(normal, direction) points in the direction in which v increases.
struct Tangent {
  Vec3 direction;
  float handedness = 1;
};

// World space, metres. Vertices are sorted by node and primitive, in the order of the file. If two nodes or
// instances show a mesh, its vertices appear twice.
struct SurfaceMesh {
  std::vector<Vec3> position, normal;
  std::vector<Tangent> tangent;
  std::vector<TexturePoint> uv;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

struct ImportedSurface {
  SurfaceMesh mesh;
  std::vector<std::string> warnings;  // one sentence for each thing that the import generated or repaired
};

// Ignores skins. Applies morph targets with their default weights. If a primitive has no NORMAL or is
// morphed, generates its normals by vertex_normals. If it has no TANGENT, or its normals were generated,
// generates its tangents by surface_tangents. Fails with BAD_FILE, also if a primitive has no TEXCOORD_0. The
// message says what is wrong, but does not name the file; the caller must add the name.
ImportedSurface import_surface(const std::filesystem::path& path, const ImportOptions& options = {});

// Imports from memory and opens no files. All buffers must be in `bytes` or in data URIs.
ImportedSurface import_surface(std::span<const std::byte> bytes, const MeshSelection& meshes = {});

// Generates normals and tangents for vertices that have none.

// Returns normals weighted by area and averaged over vertices at exactly the same position. A vertex gets +z
// if none of its triangles has a positive area.
std::vector<Vec3> smooth_normals(std::span<const Vec3> position,
                                 std::span<const std::array<std::uint32_t, 3>> triangle);

// Returns tangents by the rule of M. Mikkelsen's tangent space (Simulation of Wrinkled Surfaces Revisited,
// 2008), in an implementation of our own. To get the tangent of a triangle at a corner, takes the direction
// in the triangle in which u increases, makes it perpendicular to the vertex normal, and normalises it. A
// vertex gets the mean tangent of all vertices with the same position, normal and texture coordinates,
// weighted by the angles of the corners. The mean contains only triangles with the handedness of the vertex.
// If triangles of both handednesses share a vertex, the handedness with the larger sum of angles is used.
// Triangles are ignored if their area, or their area in texture coordinates, is not above 0. A vertex that
// has only ignored triangles gets an arbitrary tangent perpendicular to its normal. Adds a sentence to
// warnings for each kind of repair.
std::vector<Tangent> surface_tangents(const SurfaceMesh& mesh, std::vector<std::string>& warnings);

// Returns the unit vector nearest to a direction that is perpendicular to a unit normal. If the direction is
// along the normal, the tangent is arbitrary.
Vec3 across_normal(Vec3 normal, Vec3 direction);

}  // namespace nook::bake
