#pragma once

#include <functional>

#include "bakers/mannequin/body_mesh.h"
#include "bakers/mannequin/body_sdf.h"

namespace nook::mannequin {

/// The target length of edges at a point of the skin, in metres.
using EdgeLength = std::function<double(const Vec3& point_m)>;

/// Rebuilds a closed manifold with edges near the target length: splits long edges, collapses short ones,
/// flips for even valences, slides vertices along the skin, and ends with every vertex on it.
TriangleMesh remesh(const TriangleMesh& dense, const BodySdf& sdf, const EdgeLength& edge_length_m,
                    int rounds);

}  // namespace nook::mannequin
