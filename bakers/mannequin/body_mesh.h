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

/// Unit normals, each the mean of the vertex's triangles weighted by area.
std::vector<Vec3> area_weighted_normals(const TriangleMesh& mesh);

/// The vertices that share an edge with each vertex.
std::vector<std::vector<std::uint32_t>> vertex_neighbours(const TriangleMesh& mesh);

/// The target length of edges at a point of the skin, in metres.
using EdgeLength = std::function<double(const Vec3& point_m)>;

/// Rebuilds a closed manifold with edges near the target length: splits long edges, collapses short ones,
/// flips for even valences, slides vertices along the skin, and ends with every vertex on it.
TriangleMesh remesh(const TriangleMesh& dense, const BodySdf& sdf, const EdgeLength& edge_length_m,
                    int rounds);

/// Makes the figure's skin in the bind pose. It has about 6,000 vertices and is finest at the fingers and the
/// face.
TriangleMesh make_body_mesh();

}  // namespace nook::mannequin
