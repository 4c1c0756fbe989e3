// Finds edges of a mesh that a pose tears. Torn edges show that a bone does not move with the bone of the
// neighbouring skin.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// An edge is torn if it is stretched to more than this multiple of its rest length ...
constexpr float torn_stretch = 2.5f;
// ... and grows by more than this share of the diagonal of the resting body. Without the second condition,
// short edges at an elbow, which stretch far without a visible tear, would count as torn.
constexpr float torn_growth = 0.01f;

using MeshEdge = std::array<std::uint32_t, 2>;

// Returns each edge of the mesh once, in ascending order. The smaller vertex index of an edge comes first.
std::vector<MeshEdge> mesh_edges(const SkinnedMesh& mesh);

// Counts the edges that one pose tears. `posed` contains the skinned vertices of the pose.
std::size_t count_torn(const SkinnedMesh& mesh, std::span<const MeshEdge> edges, std::span<const Vec3> posed);

// Returns the share of torn edges over all edges and poses, 0 to 1. Returns 0 if there are no edges or poses.
double torn_share(const SkinnedMesh& mesh, std::span<const Pose> poses);

}  // namespace nook::bake
