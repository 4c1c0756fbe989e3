#include "bakers/character/hands.h"

#include <algorithm>
#include <numbers>

#include "bakers/character/rig_anatomy.h"

namespace nook::bake {
namespace {

struct Rig {
  const SkinnedMesh& mesh;
  std::span<const Joint> joints;
  const BodyTree& tree;

  Vec3 origin(std::size_t bone) const { return joint_origin(mesh.bones[bone]); }
};

struct Hand {
  Vec3 along;                         // from the wrist to the knuckles, of unit length
  Vec3 thumb;                         // sum of the vectors from the wrist to the thumb's joints
  std::vector<std::size_t> knuckles;  // bones
  std::vector<std::size_t> members;   // bones of fingers and thumb
};

// Returns the bones of the palm that `wrist` belongs to: `wrist` itself and its siblings with the same role.
std::vector<std::size_t> palm_bones(std::span<const Joint> joints, const BodyTree& tree, std::size_t wrist) {
  std::vector<std::size_t> bones{wrist};
  for (std::size_t b = 0; b < joints.size(); ++b)
    if (b != wrist && tree.parent[wrist] >= 0 && tree.parent[b] == tree.parent[wrist] &&
        joints[b].role == JointRole::hand && joints[b].side == joints[wrist].side)
      bones.push_back(b);
  return bones;
}

Hand hand_of(const Rig& rig, std::size_t wrist) {
  Hand hand;
  const std::vector<std::size_t> palm = palm_bones(rig.joints, rig.tree, wrist);
  Vec3 origin;
  for (const std::size_t b : palm) origin += (1 / float(palm.size())) * rig.origin(b);
  // If a palm has several bones, the thumb is their sibling.
  const std::size_t root = palm.size() > 1 ? std::size_t(rig.tree.parent[wrist]) : wrist;
  for (std::size_t b = 0; b < rig.joints.size(); ++b) {
    if (!is_below(rig.tree, b, root)) continue;
    if (rig.joints[b].role == JointRole::finger) {
      hand.members.push_back(b);
      if (rig.joints[b].segment == 0) {
        hand.knuckles.push_back(b);
        hand.along += normalised(rig.origin(b) - origin);
      }
    } else if (rig.joints[b].role == JointRole::thumb) {
      hand.members.push_back(b);
      hand.thumb += rig.origin(b) - origin;
    }
  }
  hand.along = normalised(hand.along);
  return hand;
}

// Returns the direction across the knuckles, from the little finger to the index finger. The index finger's
// knuckle is the outer knuckle that is nearer to the thumb.
Vec3 across_knuckles(const Rig& rig, const Hand& hand, Vec3 up) {
  Vec3 across;
  for (const std::size_t a : hand.knuckles)
    for (const std::size_t b : hand.knuckles) {
      const Vec3 d = rig.origin(a) - rig.origin(b);
      if (length(d) > length(across)) across = d;
    }
  if (length(across) == 0) across = cross(hand.along, up);
  if (dot(across, hand.thumb) < 0) across = -across;
  return normalised(across - dot(across, hand.along) * hand.along);
}

// Returns the axis across the knuckles, with the sign that makes fingers curl towards the palm. If the
// fingers are curled at rest, their curl shows most reliably where the palm is. Otherwise, the palm is on the
// thumb's side.
Vec3 finger_axis(const Rig& rig, const Hand& hand, Vec3 across) {
  constexpr float least_curl = 0.05f;  // sine of the angle between neighbouring joints, mean over fingers
  Vec3 bend;
  for (const std::size_t b : hand.members) {
    const Joint& joint = rig.joints[b];
    const std::int32_t parent = rig.tree.parent[b];
    if (joint.role != JointRole::finger || joint.continuation < 0 || joint.segment == 0 || parent < 0)
      continue;
    bend += cross(limb_direction(rig.mesh, rig.joints, std::size_t(parent)),
                  limb_direction(rig.mesh, rig.joints, b));
  }
  const bool is_curled = length(bend) > least_curl * float(hand.knuckles.size());
  const float sign = is_curled ? dot(bend, across) : dot(cross(across, hand.along), hand.thumb);
  return sign < 0 ? -across : across;
}

// Returns the axis about which the thumb folds over the palm. The axis is perpendicular to the thumb, halfway
// between the palm's normal and the axis across the knuckles.
Vec3 thumb_axis(const Hand& hand, Vec3 finger_axis, Vec3 across) {
  const Vec3 palm = cross(finger_axis, hand.along);
  const Vec3 fold = cross(normalised(hand.thumb), normalised(palm - across));
  return normalised(dot(fold, fold) > 0 ? fold : finger_axis);
}

}  // namespace

std::vector<char> parted_palms(std::span<const Joint> joints, const BodyTree& tree) {
  std::vector<char> parted(joints.size(), 0);
  for (std::size_t b = 0; b < joints.size(); ++b)
    parted[b] = joints[b].role == JointRole::hand && palm_bones(joints, tree, b).size() > 1;
  return parted;
}

std::array<BodyPoint, 2> palms(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree) {
  const Rig rig{mesh, joints, tree};
  std::array<BodyPoint, 2> palm;
  for (std::size_t wrist = 0; wrist < joints.size(); ++wrist) {
    if (joints[wrist].role != JointRole::hand || joints[wrist].side == Side::none) continue;
    Vec3 sum;
    float count = 0;
    for (const std::size_t knuckle : hand_of(rig, wrist).knuckles) {
      sum += rig.origin(knuckle);
      ++count;
    }
    palm[joints[wrist].side == Side::right] = {std::int32_t(wrist),
                                               count == 0 ? rig.origin(wrist) : sum * (1 / count)};
  }
  return palm;
}

HandFrame hand_frame(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                     std::size_t wrist, Vec3 up) {
  const Rig rig{mesh, joints, tree};
  const Hand hand = hand_of(rig, wrist);
  HandFrame frame;
  frame.knuckles = rig.origin(wrist);
  if (hand.knuckles.empty()) return frame;
  Vec3 sum;
  for (const std::size_t knuckle : hand.knuckles) sum += rig.origin(knuckle);
  frame.knuckles = sum * (1 / float(hand.knuckles.size()));
  frame.along = hand.along;
  frame.across = across_knuckles(rig, hand, up);
  frame.palm = normalised(cross(finger_axis(rig, hand, frame.across), frame.along));
  return frame;
}

Vec3 finger_turn(const Joint& joint, Vec3 curl_axis, float curl) {
  static constexpr float reach_degrees[3] = {85, 100, 70};
  constexpr float radians = std::numbers::pi_v<float> / 180;
  return std::clamp(curl, -0.1f, 1.1f) * reach_degrees[std::min<int>(joint.segment, 2)] * radians * curl_axis;
}

std::vector<char> laden_fingers(const SkinnedMesh& mesh, std::span<const Joint> joints,
                                const BodyTree& tree) {
  // Share of the body's diagonal. On a person with stretched arms, a finger has a share of 4 %. On a cartoon
  // hand, it has 8 %.
  constexpr float longest_finger = 0.15f;
  std::vector<float> reach(mesh.bones.size(), 0);  // distance from each bone's joint to its farthest skin
  Vec3 low, high;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 p = mesh.position[i];
    const std::size_t bone = mesh.weights[i].bone[0];
    reach[bone] = std::max(reach[bone], length(p - joint_origin(mesh.bones[bone])));
    if (i == 0) low = high = p;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  std::vector<char> laden(mesh.bones.size(), 0);
  for (std::size_t i = tree.order.size(); i-- > 0;) {
    const std::uint32_t b = tree.order[i];
    if (joints[b].role != JointRole::finger && joints[b].role != JointRole::thumb) continue;
    if (reach[b] > longest_finger * length(high - low)) laden[b] = 1;
    // If a joint of a finger carries an object, the joints between it and the palm carry the object too.
    const std::int32_t p = tree.parent[b];
    if (laden[b] && p >= 0) laden[std::size_t(p)] = joints[std::size_t(p)].role == joints[b].role;
  }
  return laden;
}

std::vector<Vec3> curl_axes(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                            Vec3 up) {
  const Rig rig{mesh, joints, tree};
  std::vector<Vec3> axes(mesh.bones.size());
  for (std::size_t wrist = 0; wrist < joints.size(); ++wrist) {
    if (joints[wrist].role != JointRole::hand) continue;
    const Hand hand = hand_of(rig, wrist);
    if (hand.knuckles.empty()) continue;
    const Vec3 across = across_knuckles(rig, hand, up);
    const Vec3 axis = finger_axis(rig, hand, across);
    for (const std::size_t b : hand.members)
      axes[b] = joints[b].role == JointRole::finger ? axis : thumb_axis(hand, axis, across);
  }
  return axes;
}

}  // namespace nook::bake
