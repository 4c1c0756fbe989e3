// Which way a body looks, and which way its limbs lie, in its rest pose.
#pragma once

#include <span>

#include "bakers/character/joint_roles.h"

namespace nook::bake {

// Directions of the body in rest space. Rest space is that of glTF: +y is up.
struct BodyFrame {
  Vec3 left, up, forward;
};

// The joints whose side is known show where left is; without any it is +x.
BodyFrame body_frame(const SkinnedMesh& mesh, std::span<const Joint> joints);

// From a joint to the one that continues its limb, of unit length in rest space; zero where there is none.
Vec3 limb_direction(const SkinnedMesh& mesh, std::span<const Joint> joints, std::size_t bone);

}  // namespace nook::bake
