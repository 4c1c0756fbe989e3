#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/mannequin/shape_primitives.h"

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

/// Makes the figure's skin in the bind pose. It has about 6,000 vertices and is finest at the fingers and the
/// face.
TriangleMesh make_body_mesh();

}  // namespace nook::mannequin
