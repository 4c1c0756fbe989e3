// The role of each bone of a rig, guessed from names and hierarchy, so that automatic poses can bend knees
// backwards.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

enum class JointRole : std::uint8_t {
  other,
  pelvis,
  spine,
  neck,
  head,
  clavicle,
  upper_arm,
  forearm,
  hand,
  finger,
  thumb,
  thigh,
  calf,
  foot,
  toe,
};

enum class Side : std::uint8_t { none, left, right };

struct Joint {
  JointRole role = JointRole::other;
  Side side = Side::none;
  std::uint8_t segment = 0;        // of fingers: 0 at the knuckle, then 1, 2
  std::int32_t continuation = -1;  // the bone that continues the limb: its first child of a later role, or
                                   // the foot or hand that the rig keeps beside it; -1: none
};

// Understands the naming of the common humanoid rigs (Unreal, Rigify, Biped, Mixamo, Unity); what it does not
// recognise is JointRole::other.
std::vector<Joint> joint_roles(const SkinnedMesh& mesh);

}  // namespace nook::bake
