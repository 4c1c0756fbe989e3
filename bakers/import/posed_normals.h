// Finds the front sides of a posed mesh. If a joint has a negative scale, its bone mirrors the triangles that
// follow it. Their corners are then clockwise as seen from the front.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Returns the triangles of a mesh in a pose, each with its front outside. Use them for normals and for points
// on the surface. A vertex is mirrored if its blended matrix has a negative determinant. If all three
// vertices of a triangle are mirrored, the order of its corners is reversed. If only some are mirrored, the
// triangle has no front and is left out. Returns mesh.triangle if no bone mirrors, and `storage` otherwise.
std::span<const std::array<std::uint32_t, 3>> posed_triangles(
    const SkinnedMesh& mesh, const Pose& pose, std::vector<std::array<std::uint32_t, 3>>& storage);

// Computes the vertex_normals of posed_triangles. Pass the result of skin_positions as `positions`.
void posed_normals(const SkinnedMesh& mesh, const Pose& pose, std::span<const Vec3> positions,
                   std::vector<Vec3>& out);

}  // namespace nook::bake
