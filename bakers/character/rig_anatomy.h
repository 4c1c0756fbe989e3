// Interprets a rig as a body: the places and roles of its joints, how they are connected, and the directions
// of limbs.
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

// Returns the joint's origin in rest space, metres.
inline Vec3 joint_origin(const Bone& bone) {
  return {bone.frame_rest.m[3], bone.frame_rest.m[7], bone.frame_rest.m[11]};
}

// The role of each bone of a rig. If a rig has the bone names and the shape of a person, the roles come from
// the names, so that automatic poses know where knees can bend. For every other rig, the roles come from the
// mesh, the hierarchy and the rest pose (rig_geometry.h), and names are only a hint.

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
  // Only bodies that are not people have the roles below. Their spines, necks, heads and feet have the roles
  // above.
  leg,
  arm,
  wing,
  tail,
  jaw,
  ear,
  prop,     // an object that the body carries: an unconnected part of the mesh on another bone
  helper,   // a twist bone or similar, which only moves with its parent
  control,  // does not move any part of the mesh
};
constexpr std::size_t joint_role_count = std::size_t(JointRole::control) + 1;

// name_of returns a role's lower-case name, as rig files and `nook inspect --rig` write it. The other
// function returns the role for a name.
const char* name_of(JointRole role);
std::optional<JointRole> role_named(std::string_view name);

enum class Side : std::uint8_t { none, left, right };

struct Joint {
  JointRole role = JointRole::other;
  Side side = Side::none;
  std::uint8_t segment = 0;  // for fingers: 0 at the knuckle, then 1, 2
  // The bone that continues the limb, or -1. It is the first child with a later role, or a loose foot or
  // hand.
  std::int32_t continuation = -1;
  std::int32_t limb = -1;    // number of the leg, wing, tail, ... that the bone belongs to; -1: none
  std::int32_t parent = -1;  // parent in the body (see BodyTree); -1: a root
};

// A user's correction of one bone (rig_file.h). Fields that are not set are determined automatically.
struct BoneCorrection {
  std::uint32_t bone = 0;
  std::optional<JointRole> role;
  std::optional<Side> side;
  std::optional<std::int32_t> limb, parent;  // parent -1: a root

  bool operator==(const BoneCorrection&) const = default;
};
using RigCorrections = std::vector<BoneCorrection>;

// Finds roles only by names, for common humanoid rigs (Unreal, Rigify, Biped, Mixamo, Unity). Bones with
// other names get JointRole::other.
std::vector<Joint> named_roles(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// Returns true if the joints belong to a person. Each side must have one thigh with a calf, and an upper arm.
// The vertical distance from the hips to the shoulders must be larger than the horizontal one.
bool is_person(const SkinnedMesh& mesh, std::span<const Joint> joints);

std::vector<Joint> joint_roles(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

// The hierarchy of a body. It can differ from the hierarchy of its rig. For example, a rig may move feet by
// inverse kinematics and keep them under its root, but in the body the feet belong to the calves.

struct BodyTree {
  std::vector<std::int32_t> parent;  // of each bone; -1: a root
  std::vector<std::uint32_t> order;  // bones, parents before children
};

// Returns the rig's hierarchy, except that a bone that continues a limb is a child of that limb
// (Joint::parent).
BodyTree body_tree(const SkinnedMesh& mesh, std::span<const Joint> joints);
BodyTree body_tree(const SkinnedMesh& mesh);

// Returns the bones with parents before children.
std::vector<std::uint32_t> parents_first(std::span<const std::int32_t> parent);

// Returns the lower-case words of a bone's name without its namespace. Splits at characters that are not
// letters, and where a capital follows a small letter.
std::vector<std::string> words_of(std::string_view name);

// Returns true if `bone` is a descendant of `ancestor`.
bool is_below(const BodyTree& tree, std::size_t bone, std::size_t ancestor);

// The direction in which a body faces in its rest pose, and the directions of its limbs.

// Directions of the body in rest space. Rest space uses the axes of glTF, with +y up.
struct BodyFrame {
  Vec3 left, up, forward;
};

// Left is where the joints on the left side are. If no joint has a side, left is +x.
BodyFrame body_frame(const SkinnedMesh& mesh, std::span<const Joint> joints);

// Returns the direction from a joint to the joint that continues its limb, as a unit vector in rest space.
// Returns zero if no joint continues it.
Vec3 limb_direction(const SkinnedMesh& mesh, std::span<const Joint> joints, std::size_t bone);

}  // namespace nook::bake
