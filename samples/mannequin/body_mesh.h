#pragma once

#include "samples/mannequin/triangle_mesh.h"

namespace nook_samples::mannequin {

/// Makes the figure's skin in the bind pose. It has about 6,000 vertices and is finest at the fingers and the
/// face.
TriangleMesh make_body_mesh();

}  // namespace nook_samples::mannequin
