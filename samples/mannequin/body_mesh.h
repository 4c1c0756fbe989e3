#pragma once

#include "samples/mannequin/triangle_mesh.h"

namespace nook_samples::mannequin {

/// The figure's skin in the bind pose: about 6,000 vertices, finest at the fingers and the face.
TriangleMesh make_body_mesh();

}  // namespace nook_samples::mannequin
