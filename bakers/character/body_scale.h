// The size of a body, and bodies of another size: rates, radii and reaches of a bake are metres of a person,
// and a file may be in centimetres.
#pragma once

#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Returns the power of two by which a body's largest extent comes nearest to 1.7 m, the height of a person: 1
// for bodies of 1.2 m to 2.4 m. Powers of two change no digit of a number.
float scale_to_person(const SkinnedMesh& mesh);

SkinnedMesh scaled(const SkinnedMesh& mesh, float scale);
std::vector<Pose> scaled(std::span<const Pose> poses, float scale);

// Scales everything that a bake of a mesh makes: spheres, key points and bounds.
void scale_model(CharacterModel& model, float scale);

}  // namespace nook::bake
