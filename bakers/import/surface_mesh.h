// A static textured shape of a glTF 2.0 file: the triangles of its default scene with the normal, the tangent
// and the texture coordinates of each vertex, in the file's own vertex order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/linked_files.h"
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
// order; a mesh that two nodes show appears twice.
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

// Skins are ignored, and morph targets have their default weights. NORMAL is made by vertex_normals where a
// primitive has none or is morphed. Tangents are made by surface_tangents where a primitive lacks TANGENT, or
// its normals are made. Fails with BAD_FILE, also where a primitive has no TEXCOORD_0; the message names the
// fault, and the caller adds the name of the file.
ImportedSurface import_surface(const std::filesystem::path& path, LinkedFiles linked = LinkedFiles::folder);

// From memory, without access to any file: buffers must be in the bytes or in data URIs.
ImportedSurface import_surface(std::span<const std::byte> bytes);

}  // namespace nook::bake
