// Handles bodies from files that are not in metres. The floors, walls and priors of a fit are in metres.
// Without scaling, a fox 176 m long would stand on a floor as small as its paw.
#pragma once

#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Returns 1 for bodies with an extent of 0.2 m to 14 m. For other bodies, returns the power of two that
// brings the extent closest to 1.7 m. Scaling by a power of two causes no rounding.
float scale_to_metres(const SkinnedMesh& mesh);

SkinnedMesh mesh_in_metres(const SkinnedMesh& mesh, float scale);
std::vector<Pose> poses_in_metres(std::span<const Pose> poses, float scale);
std::vector<WorldCaster> casters_in_metres(std::span<const WorldCaster> casters, float scale);

}  // namespace nook::bake
