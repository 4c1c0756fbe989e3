// Decides which side of a mesh is its front, from the normals of the file and from mirrored nodes. Also finds
// closed parts whose front is on the inside.
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

// The vertices and triangles of one primitive as stored in the file, in mesh space.
struct PrimitiveSurface {
  std::span<const float> position;  // three floats per vertex
  std::span<const float> normal;    // three floats per vertex; empty: the primitive has no normals
  std::span<const std::array<std::uint32_t, 3>> triangle;
};

// Returns the NORMAL attribute of a primitive, three floats for each of `vertices`. A normal that is not
// finite becomes zero. Returns an empty array if the primitive has no normals, or if their type is not
// allowed by glTF. Fails with BAD_FILE if the number of normals is wrong.
std::vector<float> read_normals(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                std::size_t vertices, const std::string& what);

// Returns true if most of the area faces against the normals, and false if most of it faces along them.
// Returns nothing if the two areas differ by less than 1 % of the total, for example on two-sided cards whose
// faces all have the normals of one side.
std::optional<bool> faces_against_normals(const PrimitiveSurface& surface);

// Returns true if the corners of each triangle must be reversed, so that they are counter-clockwise as seen
// from the front after space_from_mesh. The normals decide. Without normals, the sign of the determinant of
// the node's global transform decides (glTF 2.0, section 3.7.4). If only one of a skin and its node mirrors,
// the sign of the enclosed volume decides. The reason is that exporters mirror positions and normals, but do
// not change the order of the corners. The time is linear in the primitive.
bool turns_round(const PrimitiveSurface& surface, const Affine& space_from_mesh, bool node_mirrors);

// Closed parts of a mesh (connected triangles without a border) whose triangles face inwards. The wall of a
// cavity inside another closed part is not reported. The time is O(triangles * (1 + parts that face
// inwards)). The search ends after 64 such parts.
struct InsideOutPart {
  std::uint32_t node = 0, primitive = 0;  // the node and primitive that contain most of its triangles
  std::size_t triangles = 0;
};
std::vector<InsideOutPart> inside_out_parts(const SurfaceParts& parts, std::span<const Vec3> position,
                                            std::span<const std::array<std::uint32_t, 3>> triangle);

// Adds one sentence for each primitive with such parts, at most four. Skips the hulls, which
// warn_of_close_surfaces reports.
void warn_of_inside_out_parts(const tinygltf::Model& model, const SurfaceParts& parts,
                              std::span<const Vec3> position,
                              std::span<const std::array<std::uint32_t, 3>> triangle,
                              std::span<const OutlineHull> hulls, std::vector<std::string>& warnings);

}  // namespace nook::bake
