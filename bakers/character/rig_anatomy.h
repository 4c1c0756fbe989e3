// A rig read as a body: where its joints are, what they are for, how they hang together and which way they
// point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Where a joint is.

// In rest space, metres.
inline Vec3 joint_origin(const Bone& bone) {
  return {bone.frame_rest.m[3], bone.frame_rest.m[7], bone.frame_rest.m[11]};
}

// The role of each bone of a rig, guessed from names and hierarchy, so that automatic poses can bend knees
// backwards.

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

// The hierarchy by which a body hangs together, which is not always that of its rig: feet that a rig moves by
// inverse kinematics are children of its root, and belong to the calves.

struct BodyTree {
  std::vector<std::int32_t> parent;  // of each bone; -1: a root
  std::vector<std::uint32_t> order;  // bones, each behind its parent
};

// The rig's hierarchy, in which a bone that continues a limb (Joint::continuation) hangs on that limb.
BodyTree body_tree(const SkinnedMesh& mesh, std::span<const Joint> joints);
BodyTree body_tree(const SkinnedMesh& mesh);

// Returns true where a bone hangs below another.
bool is_below(const BodyTree& tree, std::size_t bone, std::size_t ancestor);

// Which way a body looks, and which way its limbs lie, in its rest pose.

// Directions of the body in rest space. Rest space is that of glTF: +y is up.
struct BodyFrame {
  Vec3 left, up, forward;
};

// The joints whose side is known show where left is; without any it is +x.
BodyFrame body_frame(const SkinnedMesh& mesh, std::span<const Joint> joints);

// From a joint to the one that continues its limb, of unit length in rest space; zero where there is none.
Vec3 limb_direction(const SkinnedMesh& mesh, std::span<const Joint> joints, std::size_t bone);

}  // namespace nook::bake
