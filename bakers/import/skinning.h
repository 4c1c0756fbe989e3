// Posed positions, normals and areas of welded vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Linear blend skinning. `out_ws` is resized to the mesh's vertices; reuse it between poses.
void skin_positions(const SkinnedMesh& mesh, const Pose& pose, std::vector<Vec3>& out_ws);

// Area-weighted unit normals. A vertex whose faces cancel out takes the normal of one of them, +y where all
// its faces are degenerate or where it has none.
void vertex_normals(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> positions,
                    std::vector<Vec3>& out);

// Mixed Voronoi area of each vertex (Meyer, Desbrun, Schroeder, Barr 2003, "Discrete Differential-Geometry
// Operators for Triangulated 2-Manifolds", section 3.3). They add up to the surface's area.
std::vector<float> vertex_areas(const SkinnedMesh& mesh, std::span<const Vec3> positions);

}  // namespace nook::bake
