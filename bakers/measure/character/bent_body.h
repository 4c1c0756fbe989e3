// A posed character with AO and bent normals as its model gives them to a host.
#pragma once

#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// One entry for each welded vertex, in world space and metres; normals have unit length.
struct BentBody {
  std::vector<Vec3> position, normal, bent;
  std::vector<float> ao;
};

// A occluded direction turns with its vertex, as the vertex shader of a host skins it. Throws Failure:
// UNSUPPORTED (the model was baked without bent normals).
BentBody bent_body(const bake::SkinnedMesh& mesh, const CharacterModel& model, const bake::Pose& pose);

}  // namespace nook::measure
