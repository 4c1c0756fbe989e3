// The front of a posed mesh. A bone that mirrors, by a negative scale of its joint, turns the triangles round
// that follow it: their corners go round the back counter-clockwise.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// The triangles of a mesh in a pose, each with its front outside, for normals and for points on the surface.
// A vertex is mirrored where its blended matrix has a negative determinant. Triangles of mirrored vertices
// are turned round; a triangle between mirrored and other vertices has no front and is left out. Returns
// mesh.triangle where no bone mirrors, and `storage` otherwise.
std::span<const std::array<std::uint32_t, 3>> posed_triangles(
    const SkinnedMesh& mesh, const Pose& pose, std::vector<std::array<std::uint32_t, 3>>& storage);

// vertex_normals of posed_triangles. positions: of skin_positions.
void posed_normals(const SkinnedMesh& mesh, const Pose& pose, std::span<const Vec3> positions,
                   std::vector<Vec3>& out);

}  // namespace nook::bake
