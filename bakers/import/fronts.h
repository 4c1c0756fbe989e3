// Which side of a mesh is its front: the normals of a file and the mirroring of its nodes decide, and closed
// parts whose front is inside are found.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/coincident_surfaces.h"
#include "sdk/src/core/affine.h"

namespace nook::bake {

// The vertices and triangles of one primitive as the file has them, in the space of its mesh.
struct PrimitiveSurface {
  std::span<const float> position;  // three per vertex
  std::span<const float> normal;    // the same; empty: the primitive has none
  std::span<const std::array<std::uint32_t, 3>> triangle;
};

// NORMAL of a primitive, three floats for each of `vertices`, zero where it is not finite; empty without it
// or with a type that glTF does not allow. Fails with BAD_FILE on a wrong number.
std::vector<float> read_normals(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                std::size_t vertices, const std::string& what);

// Returns true if most of the area faces against the normals, and false if most of it faces along them.
// Returns nothing if the two differ by less than 1 % of the area, as on cards with the normals of one side.
std::optional<bool> faces_against_normals(const PrimitiveSurface& surface);

// Returns whether the corners of each triangle must change their order, so that they go round the front
// counter-clockwise after `space_from_mesh`. The normals decide. Without normals, the sign of the determinant
// of the node's global transform decides (glTF 2.0, section 3.7.4). If a skin mirrors and its node does not,
// or the reverse, the side that the primitive encloses decides. Exporters mirror positions and normals, but
// not the order. Linear in the primitive.
bool turns_round(const PrimitiveSurface& surface, const Affine& space_from_mesh, bool node_mirrors);

// Closed parts of a mesh (connected triangles without a border) whose triangles face inwards. The wall of a
// cavity inside another closed part does not count. The time is linear in the triangles, once more for each
// part that faces inwards. The search ends after 64 such parts.
struct InsideOutPart {
  std::uint32_t node = 0, primitive = 0;  // that most of its triangles come from
  std::size_t triangles = 0;
};
std::vector<InsideOutPart> inside_out_parts(const SurfaceParts& parts, std::span<const Vec3> position,
                                            std::span<const std::array<std::uint32_t, 3>> triangle);

// Adds one sentence for each primitive with such parts, at most four. The hulls have sentences of their own.
void warn_of_inside_out_parts(const tinygltf::Model& model, const SurfaceParts& parts,
                              std::span<const Vec3> position,
                              std::span<const std::array<std::uint32_t, 3>> triangle,
                              std::span<const OutlineHull> hulls, std::vector<std::string>& warnings);

}  // namespace nook::bake
