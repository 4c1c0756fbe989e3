#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samples/mannequin/shape_primitives.h"

namespace nook_samples::mannequin {

using Triangle = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Vec3> positions_m;
  std::vector<Triangle> triangles;  ///< Counter-clockwise seen from outside.
};

/// Unit normals, each the mean of the vertex's triangles weighted by area.
std::vector<Vec3> area_weighted_normals(const TriangleMesh& mesh);

/// The vertices that share an edge with each vertex.
std::vector<std::vector<std::uint32_t>> vertex_neighbours(const TriangleMesh& mesh);

}  // namespace nook_samples::mannequin
