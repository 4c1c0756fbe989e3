#include "bakers/character/rig_anatomy.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/character/rig_geometry.h"

namespace nook::bake {

std::vector<std::string> words_of(std::string_view name) {
  const std::size_t space = name.find_last_of(":|");
  if (space != std::string_view::npos) name.remove_prefix(space + 1);
  std::vector<std::string> words(1);
  char before = 0;
  for (char c : name) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    const bool starts =
        std::isupper(static_cast<unsigned char>(c)) && std::islower(static_cast<unsigned char>(before));
    if (!letter || starts) words.emplace_back();
    if (letter || std::isdigit(static_cast<unsigned char>(c)))
      words.back() += char(std::tolower(static_cast<unsigned char>(c)));
    before = c;
  }
  std::erase(words, std::string());
  return words;
}

namespace {

constexpr std::array<const char*, joint_role_count> role_names{
    "other", "pelvis", "spine", "neck",  "head", "clavicle", "upper_arm", "forearm",
    "hand",  "finger", "thumb", "thigh", "calf", "foot",     "toe",       "leg",
    "arm",   "wing",   "tail",  "jaw",   "ear",  "prop",     "helper",    "control"};

bool contains(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    if (text.find(part) != std::string::npos) return true;
  return false;
}

Side side_of(const std::vector<std::string>& words) {
  for (const std::string& w : words) {
    if (w == "l" || w == "left") return Side::left;
    if (w == "r" || w == "right") return Side::right;
  }
  return Side::none;
}

JointRole role_of(const std::string& text, Side side, JointRole parent) {
  if (contains(text, {"twist", "roll", "leaf", "pole", "ik"}) && !contains(text, {"spike"}))
    return JointRole::other;
  const bool facial =
      contains(text, {"eye", "brow", "mouth", "lip", "cheek", "jaw", "tongue", "nose", "tail", "ear"});
  if (facial && !contains(text, {"forearm"})) return JointRole::other;
  if (contains(text, {"thumb", "finger0"})) return JointRole::thumb;
  if (contains(text, {"index", "middle", "ring", "pinky", "little", "finger"})) return JointRole::finger;
  if (contains(text, {"toe", "ball"})) return JointRole::toe;
  if (contains(text, {"foot", "ankle"})) return parent == JointRole::foot ? JointRole::toe : JointRole::foot;
  if (contains(text, {"calf", "shin", "lowerleg", "knee"})) return JointRole::calf;
  if (contains(text, {"thigh", "upleg", "upperleg"})) return JointRole::thigh;
  if (contains(text, {"forearm", "lowerarm", "elbow"})) return JointRole::forearm;
  if (contains(text, {"upperarm", "uparm"})) return JointRole::upper_arm;
  if (contains(text, {"clavicle", "collar", "shoulder"})) return JointRole::clavicle;
  if (contains(text, {"hand", "wrist", "palm", "fist"}))
    return parent == JointRole::hand ? JointRole::other : JointRole::hand;
  if (contains(text, {"neck"})) return JointRole::neck;
  if (contains(text, {"head"})) return JointRole::head;
  if (contains(text, {"spine", "chest", "torso", "abdomen", "waist"})) return JointRole::spine;
  if (contains(text, {"pelvis", "hip"})) return side == Side::none ? JointRole::pelvis : JointRole::thigh;
  // Without a prefix, "arm" or "leg" stands for the next part of the limb.
  if (contains(text, {"arm"}) && side != Side::none)
    return parent == JointRole::upper_arm ? JointRole::forearm
           : parent == JointRole::forearm ? JointRole::hand
                                          : JointRole::upper_arm;
  if (contains(text, {"leg"}) && side != Side::none)
    return parent == JointRole::thigh  ? JointRole::calf
           : parent == JointRole::calf ? JointRole::foot
           : parent == JointRole::foot ? JointRole::toe
                                       : JointRole::thigh;
  return JointRole::other;
}

// Returns the role that comes next on a limb.
JointRole next_role(JointRole role) {
  switch (role) {
    case JointRole::clavicle:
      return JointRole::upper_arm;
    case JointRole::upper_arm:
      return JointRole::forearm;
    case JointRole::forearm:
      return JointRole::hand;
    case JointRole::thigh:
      return JointRole::calf;
    case JointRole::calf:
      return JointRole::foot;
    case JointRole::foot:
      return JointRole::toe;
    default:
      return role;  // spines, necks and fingers continue with the same role
  }
}

// Rigs with inverse kinematics keep feet and hands outside their limbs. Attaches each foot or hand to the
// limb of the same side that has no end yet.
void attach_loose_ends(std::vector<Joint>& joints) {
  const auto attach = [&](JointRole limb, JointRole end) {
    for (std::size_t b = 0; b < joints.size(); ++b) {
      if (joints[b].role != limb || joints[b].side == Side::none || joints[b].continuation >= 0) continue;
      for (std::size_t other = 0; other < joints.size(); ++other)
        if (joints[other].role == end && joints[other].side == joints[b].side) {
          joints[b].continuation = std::int32_t(other);
          break;
        }
    }
  };
  attach(JointRole::calf, JointRole::foot);
  attach(JointRole::forearm, JointRole::hand);
}

}  // namespace

std::vector<Joint> named_roles(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  std::vector<Joint> joints(mesh.bones.size());
  std::vector<const BoneCorrection*> corrected(joints.size(), nullptr);
  for (const BoneCorrection& c : corrections) corrected[c.bone] = &c;
  for (std::size_t b = 0; b < joints.size(); ++b) {
    const std::vector<std::string> words = words_of(mesh.bones[b].name);
    std::string text;
    Joint& joint = joints[b];
    joint.side = side_of(words);
    for (const std::string& w : words)
      if (w != "l" && w != "r" && w != "left" && w != "right") text += w;
    const std::int32_t parent = mesh.bones[b].parent;
    const Joint above = parent >= 0 ? joints[std::size_t(parent)] : Joint{};
    if (joint.side == Side::none && above.side != Side::none) joint.side = above.side;
    const BoneCorrection* own = corrected[b];
    if (own && own->side) joint.side = *own->side;
    joint.role = own && own->role ? *own->role : role_of(text, joint.side, above.role);
    if ((joint.role == JointRole::finger || joint.role == JointRole::thumb) && above.role == joint.role)
      joint.segment = std::uint8_t(above.segment + 1);
    if (parent >= 0 && joint.role != JointRole::other && joints[std::size_t(parent)].continuation < 0 &&
        joint.role == next_role(above.role))
      joints[std::size_t(parent)].continuation = std::int32_t(b);
  }
  attach_loose_ends(joints);
  return joints;
}

std::vector<std::uint32_t> parents_first(std::span<const std::int32_t> parent) {
  std::vector<std::uint32_t> order;
  std::vector<char> placed(parent.size(), 0);
  std::vector<std::size_t> chain;
  for (std::size_t b = 0; b < parent.size(); ++b) {
    for (std::int32_t at = std::int32_t(b); at >= 0 && !placed[std::size_t(at)]; at = parent[std::size_t(at)])
      chain.push_back(std::size_t(at));
    for (; !chain.empty(); chain.pop_back()) {
      placed[chain.back()] = 1;
      order.push_back(std::uint32_t(chain.back()));
    }
  }
  return order;
}

bool is_below(const BodyTree& tree, std::size_t bone, std::size_t ancestor) {
  for (std::int32_t b = tree.parent[bone]; b >= 0; b = tree.parent[std::size_t(b)])
    if (std::size_t(b) == ancestor) return true;
  return false;
}

const char* name_of(JointRole role) {
  return role_names[std::size_t(role)];
}

std::optional<JointRole> role_named(std::string_view name) {
  const auto found = std::find(role_names.begin(), role_names.end(), name);
  if (found == role_names.end()) return std::nullopt;
  return JointRole(found - role_names.begin());
}

namespace {

// Returns the parents of a person's bones. A loose foot or hand becomes a child of its limb.
std::vector<std::int32_t> parents_of_person(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  BodyTree tree;
  for (const Bone& bone : mesh.bones) tree.parent.push_back(bone.parent);
  for (std::size_t b = 0; b < joints.size(); ++b) {
    const std::int32_t next = joints[b].continuation;
    if (next < 0 || tree.parent[std::size_t(next)] == std::int32_t(b)) continue;
    // Keeps the parent if the limb is a descendant of its foot or hand. A new parent would make a cycle.
    if (!is_below(tree, b, std::size_t(next))) tree.parent[std::size_t(next)] = std::int32_t(b);
  }
  return tree.parent;
}

Vec3 mean_origin(const SkinnedMesh& mesh, std::span<const Joint> joints, JointRole role) {
  Vec3 sum;
  float count = 0;
  for (std::size_t b = 0; b < joints.size(); ++b)
    if (joints[b].role == role) {
      sum += joint_origin(mesh.bones[b]);
      ++count;
    }
  return count > 0 ? (1 / count) * sum : Vec3{};
}

}  // namespace

bool is_person(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  // A hip bone above a thigh has the same role as the thigh. Both belong to one leg.
  const auto count = [&](JointRole role, Side side) {
    int tops = 0;
    for (std::size_t b = 0; b < joints.size(); ++b) {
      const std::int32_t above = mesh.bones[b].parent;
      tops += joints[b].role == role && joints[b].side == side &&
              (above < 0 || joints[std::size_t(above)].role != role);
    }
    return tops;
  };
  for (const Side side : {Side::left, Side::right})
    if (count(JointRole::thigh, side) != 1 || count(JointRole::calf, side) < 1 ||
        count(JointRole::upper_arm, side) < 1)
      return false;
  const Vec3 way =
      mean_origin(mesh, joints, JointRole::upper_arm) - mean_origin(mesh, joints, JointRole::thigh);
  return way.y > std::hypot(way.x, way.z);
}

namespace {

// Uses the roles found by geometry if one of them is a limb. For a mesh that is only a part of a body, such
// as a hand or an arm, names are more reliable.
std::vector<Joint> roles_of_other_body(const SkinnedMesh& mesh, std::vector<Joint> named,
                                       const RigCorrections& corrections) {
  std::vector<Joint> joints = roles_by_geometry(mesh, corrections);
  const auto is_limb = [](const Joint& joint) {
    return joint.role == JointRole::leg || joint.role == JointRole::arm || joint.role == JointRole::wing;
  };
  const auto is_known = [](const Joint& joint) { return joint.role != JointRole::other; };
  if (std::any_of(joints.begin(), joints.end(), is_limb) ||
      std::none_of(named.begin(), named.end(), is_known))
    return joints;
  for (std::size_t b = 0; b < joints.size(); ++b) named[b].parent = joints[b].parent;
  return named;
}

}  // namespace

std::vector<Joint> joint_roles(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  std::vector<Joint> joints = named_roles(mesh, corrections);
  if (!is_person(mesh, joints)) return roles_of_other_body(mesh, std::move(joints), corrections);
  std::vector<std::int32_t> parent = parents_of_person(mesh, joints);
  for (const BoneCorrection& c : corrections)
    if (c.parent) parent[c.bone] = *c.parent;
  for (std::size_t b = 0; b < joints.size(); ++b) joints[b].parent = parent[b];
  return joints;
}

BodyTree body_tree(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  BodyTree tree;
  for (std::size_t b = 0; b < mesh.bones.size(); ++b) tree.parent.push_back(joints[b].parent);
  tree.order = parents_first(tree.parent);
  return tree;
}

BodyTree body_tree(const SkinnedMesh& mesh) {
  return body_tree(mesh, joint_roles(mesh));
}

BodyFrame body_frame(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  Vec3 sum;
  for (std::size_t b = 0; b < joints.size(); ++b) {
    if (joints[b].role == JointRole::other) continue;
    if (joints[b].side == Side::left) sum += joint_origin(mesh.bones[b]);
    if (joints[b].side == Side::right) sum += -1.0f * joint_origin(mesh.bones[b]);
  }
  BodyFrame frame;
  frame.up = {0, 1, 0};
  frame.left = normalised({sum.x, 0, sum.z});
  if (dot(frame.left, frame.left) == 0) frame.left = {1, 0, 0};
  frame.forward = cross(frame.left, frame.up);
  return frame;
}

Vec3 limb_direction(const SkinnedMesh& mesh, std::span<const Joint> joints, std::size_t bone) {
  const std::int32_t next = joints[bone].continuation;
  return next < 0 ? Vec3{}
                  : normalised(joint_origin(mesh.bones[std::size_t(next)]) - joint_origin(mesh.bones[bone]));
}

}  // namespace nook::bake
