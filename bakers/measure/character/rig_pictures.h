// Draws the roles that were recognised in a rig. The skin is coloured by the roles of the bones.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/character/rig_anatomy.h"
#include "bakers/images/picture.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::measure {

// Returns the colour of a role in the picture. It is the same for every rig. Left limbs are lighter than
// right ones.
bake::Colour colour_of(bake::JointRole role);

// Writes rig.png, which shows the body in its rest pose obliquely from the front and from the back. Each face
// has the colour of the bone with the largest weight at the face's first corner. Creates the directory.
void write_rig_picture(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                       std::span<const bake::Joint> joints);

}  // namespace nook::measure
