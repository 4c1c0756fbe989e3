// Scales bodies to the size of a person. Learning rates, radii and distances of a bake are in metres and
// chosen for a person, but a file may be in centimetres.
#pragma once

#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Returns the power of two that scales the body's largest extent nearest to 1.7 m, the height of a person.
// The result is 1 for bodies whose largest extent is between 1.2 m and 2.4 m. A power of two causes no
// rounding.
float scale_to_person(const SkinnedMesh& mesh);

SkinnedMesh scaled(const SkinnedMesh& mesh, float scale);
std::vector<Pose> scaled(std::span<const Pose> poses, float scale);

// Scales everything that a bake computes: spheres, key points and bounds.
void scale_model(CharacterModel& model, float scale);

}  // namespace nook::bake
