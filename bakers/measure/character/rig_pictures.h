// A picture of what was understood of a rig: the skin coloured by the roles of its bones.
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

// rig.png: the resting body obliquely from the front and from the back. A face has the colour of the bone
// that moves most of its first corner. The directory is created.
void write_rig_picture(const std::filesystem::path& directory, const bake::SkinnedMesh& mesh,
                       std::span<const bake::Joint> joints);

}  // namespace nook::measure
