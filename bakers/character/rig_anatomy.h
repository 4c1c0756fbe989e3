// A rig read as a body: where its joints are, what they are for, how they hang together and which way they
// point.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Where a joint is.

// In rest space, metres.
inline Vec3 joint_origin(const Bone& bone) {
  return {bone.frame_rest.m[3], bone.frame_rest.m[7], bone.frame_rest.m[11]};
}

// The role of each bone of a rig. A rig that is named like a person and has a person's plan takes its roles
// from names, so that automatic poses can bend knees backwards. Every other rig is read from its mesh, its
// hierarchy and its rest pose (rig_geometry.h), where names are a hint.

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
  // Of bodies that are not people's. Their spines, necks, heads and feet have the roles above.
  leg,
  arm,
  wing,
  tail,
  jaw,
  ear,
  prop,     // what is carried: an island of the mesh on another bone
  helper,   // a twist bone or the like, which only moves with its parent
  control,  // moves no part of the mesh
};
constexpr std::size_t joint_role_count = std::size_t(JointRole::control) + 1;

// The lower-case name of a role, as rig files and `nook inspect --rig` write it, and the role of a name.
const char* name_of(JointRole role);
std::optional<JointRole> role_named(std::string_view name);

enum class Side : std::uint8_t { none, left, right };

struct Joint {
  JointRole role = JointRole::other;
  Side side = Side::none;
  std::uint8_t segment = 0;        // of fingers: 0 at the knuckle, then 1, 2
  std::int32_t continuation = -1;  // the bone that continues the limb: its first child of a later role, or
                                   // the foot or hand that the rig keeps beside it; -1: none
  std::int32_t limb = -1;          // number of the leg, wing, tail, ... that the bone belongs to; -1: none
  std::int32_t parent = -1;        // in the body, see BodyTree; -1: a root
};

// A user's correction of one bone (rig_file.h). Entries that are not set are found as without the correction.
struct BoneCorrection {
  std::uint32_t bone = 0;
  std::optional<JointRole> role;
  std::optional<Side> side;
  std::optional<std::int32_t> limb, parent;  // parent -1: a root

  bool operator==(const BoneCorrection&) const = default;
};
using RigCorrections = std::vector<BoneCorrection>;

// By names alone: the common humanoid rigs (Unreal, Rigify, Biped, Mixamo, Unity). What is not recognised is
// JointRole::other.
std::vector<Joint> named_roles(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// Returns true for joints of a person: one thigh with a calf and an upper arm on each side, and shoulders
// more above the hips than before or behind them.
bool is_person(const SkinnedMesh& mesh, std::span<const Joint> joints);

std::vector<Joint> joint_roles(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// The hierarchy by which a body hangs together, which is not always that of its rig: feet that a rig moves by
// inverse kinematics are children of its root, and belong to the calves.

struct BodyTree {
  std::vector<std::int32_t> parent;  // of each bone; -1: a root
  std::vector<std::uint32_t> order;  // bones, each behind its parent
};

// The rig's hierarchy, in which a bone that continues a limb hangs on that limb (Joint::parent).
BodyTree body_tree(const SkinnedMesh& mesh, std::span<const Joint> joints);
BodyTree body_tree(const SkinnedMesh& mesh);

// Each bone behind its parent.
std::vector<std::uint32_t> parents_first(std::span<const std::int32_t> parent);

// Lower-case words of a bone's name without its namespace: split at anything that is not a letter, and where
// a capital follows a small letter.
std::vector<std::string> words_of(std::string_view name);

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
