// A mesh of small triangles: capsules begin from vertices, and furniture has few.
#pragma once

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// The same surface, of triangles whose edges are at most a fortieth of the diagonal of its box long. Only
// positions, weights and triangles are there.
SkinnedMesh refined(const SkinnedMesh& mesh);

}  // namespace nook::bake
