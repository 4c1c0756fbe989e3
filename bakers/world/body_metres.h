// Bodies whose file is not in metres. Floors, walls and pulls of a fit are metres, so that a fox of 176 m
// would stand on a floor of its paw's size.
#pragma once

#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Returns 1 for bodies with an extent of 0.2 m to 14 m; for others the power of two that brings them nearest
// to 1.7 m. Powers of two change no digit of a number.
float scale_to_metres(const SkinnedMesh& mesh);

SkinnedMesh mesh_in_metres(const SkinnedMesh& mesh, float scale);
std::vector<Pose> poses_in_metres(std::span<const Pose> poses, float scale);
std::vector<WorldCaster> casters_in_metres(std::span<const WorldCaster> casters, float scale);

}  // namespace nook::bake
