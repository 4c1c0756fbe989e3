#pragma once

#include "samples/mannequin/body_sdf.h"
#include "samples/mannequin/triangle_mesh.h"

namespace nook_samples::mannequin {

/// Polygonises the skin by marching tetrahedra on a uniform grid. The mesh is dense and uneven, and always a
/// closed manifold.
TriangleMesh march_tetrahedra(const BodySdf& sdf, double cell_m);

}  // namespace nook_samples::mannequin
