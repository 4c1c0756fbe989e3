#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/mannequin/body_sdf.h"

namespace nook::mannequin {

using Triangle = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Vec3> positions_m;
  std::vector<Triangle> triangles;  ///< Counter-clockwise seen from outside.
};

/// Returns a unit normal for each vertex: the mean normal of its triangles, weighted by area.
std::vector<Vec3> area_weighted_normals(const TriangleMesh& mesh);

/// Returns, for each vertex, the vertices that share an edge with it.
std::vector<std::vector<std::uint32_t>> vertex_neighbours(const TriangleMesh& mesh);

/// Returns the target edge length at a point of the skin, in metres.
using EdgeLength = std::function<double(const Vec3& point_m)>;

/// Remeshes a closed manifold so that edges are close to the target length. Splits long edges, collapses
/// short ones, flips edges to equalise valences, and slides vertices along the skin. At the end, every vertex
/// is on the skin.
TriangleMesh remesh(const TriangleMesh& dense, const BodySdf& sdf, const EdgeLength& edge_length_m,
                    int rounds);

/// Makes the figure's skin in the bind pose. The mesh has about 6,000 vertices and is finest at the fingers
/// and the face.
TriangleMesh make_body_mesh();

}  // namespace nook::mannequin
