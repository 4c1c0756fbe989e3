#include "bakers/character/joined_hands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/character/rig_anatomy.h"
#include "bakers/character/rotation.h"

namespace nook::bake {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

// Upper arm and forearm must each have at least this share of their total length. With shorter bones, the arm
// cannot bend.
constexpr float least_bone = 0.1f;

Vec3 normal3(Random& random) {
  const float x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

Vec3 beside(Vec3 v, Vec3 axis) {
  return v - dot(v, axis) * axis;
}

Mat3x4 turn_part(const Mat3x4& a) {
  Mat3x4 r = a;
  r.m[3] = r.m[7] = r.m[11] = 0;
  return rotation(turn_of(r));
}

// Returns the rotation that takes one frame of unit vectors to another of the same handedness.
Mat3x4 frame_turn(const Vec3 (&from)[3], const Vec3 (&to)[3]) {
  Mat3x4 r;
  for (int i = 0; i < 12; ++i) r.m[i] = 0;
  for (int k = 0; k < 3; ++k) {
    const float a[3] = {to[k].x, to[k].y, to[k].z}, b[3] = {from[k].x, from[k].y, from[k].z};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r.m[4 * i + j] += a[i] * b[j];
  }
  return r;
}

// Returns the angle in radians by which a rotation turns about an axis.
float twist_about(const Mat3x4& turn, Vec3 axis) {
  const Vec3 v = turn_of(turn);
  const float angle = length(v);
  if (angle == 0) return 0;
  return 2 * std::atan2(std::sin(angle / 2) * dot(v, axis) / angle, std::cos(angle / 2));
}

}  // namespace

// `place` is in units of the arm's length. Other lengths are in units of the distance from wrist to knuckles.
struct JoinedHands::Grip {
  Vec3 place;       // left, up and forward from the point halfway between the shoulders
  Vec3 handle;      // direction of the handle, same axes
  float apart[2];   // distance of the knuckles from the handle, towards the back of the hand
  float along[2];   // position of the knuckles along the handle
  Vec3 miss[2];     // random error of a hand's position, as in retargeted clips
  float thumb[2];   // 1: the hand's thumb side faces the handle's end; -1: it faces the start
  Vec3 aim[2];      // added to the direction of the fingers
  Vec3 elbow[2];    // added to the direction in which elbows point
  float curl[2];    // fingers: 0 stretched, 1 a fist
  float pronation;  // the forearm's share of the hand's turn about the forearm's axis
};

struct JoinedHands::ArmPose {
  Mat3x4 upper, fore, hand;  // rotations from rest to the world
  bool reaches = false;
  float straightness = 0;  // cosine of the angle between hand and forearm
};

JoinedHands::JoinedHands(const SkinnedMesh& mesh, const RigCorrections& corrections)
    : mesh_(mesh),
      joints_(joint_roles(mesh, corrections)),
      tree_(body_tree(mesh, joints_)),
      frame_(body_frame(mesh, joints_)),
      curl_axis_(curl_axes(mesh, joints_, tree_, frame_.up)),
      arms_{find_arm(Side::left), find_arm(Side::right)} {
  if (!possible()) return;
  for (std::int32_t b = tree_.parent[std::size_t(arms_[0].upper)]; b >= 0; b = tree_.parent[std::size_t(b)])
    if (is_below(tree_, std::size_t(arms_[1].upper), std::size_t(b))) {
      chest_ = b;
      break;
    }
}

JoinedHands::Arm JoinedHands::find_arm(Side side) const {
  Arm arm;
  const std::vector<char> parted = parted_palms(joints_, tree_);
  for (std::size_t b = 0; b < joints_.size(); ++b)
    if (joints_[b].role == JointRole::upper_arm && joints_[b].side == side && joints_[b].continuation >= 0) {
      const std::int32_t fore = joints_[b].continuation;
      const std::int32_t hand = joints_[std::size_t(fore)].continuation;
      if (hand < 0 || joints_[std::size_t(hand)].role != JointRole::hand) continue;
      if (parted[std::size_t(hand)]) continue;
      arm.upper = std::int32_t(b);
      arm.fore = fore;
      arm.hand = hand;
    }
  if (arm.hand < 0) return arm;
  arm.shoulder = joint_origin(mesh_.bones[std::size_t(arm.upper)]);
  arm.elbow = joint_origin(mesh_.bones[std::size_t(arm.fore)]);
  arm.wrist = joint_origin(mesh_.bones[std::size_t(arm.hand)]);
  const float upper = length(arm.elbow - arm.shoulder), fore = length(arm.wrist - arm.elbow);
  if (std::min(upper, fore) <= least_bone * (upper + fore)) return arm;
  arm.frame = hand_frame(mesh_, joints_, tree_, std::size_t(arm.hand), frame_.up);
  const std::vector<char> laden = laden_fingers(mesh_, joints_, tree_);
  float farthest = -INFINITY;
  for (const std::uint32_t b : tree_.order) {
    const JointRole role = joints_[b].role;
    if (!is_below(tree_, b, std::size_t(arm.hand)) || (role != JointRole::finger && role != JointRole::thumb))
      continue;
    if (!laden[b]) arm.fingers.push_back(b);
    const float across = dot(joint_origin(mesh_.bones[b]) - arm.wrist, arm.frame.across);
    if (role == JointRole::finger && joints_[b].segment == 0 && across > farthest) {
      farthest = across;
      arm.index_knuckle = std::int32_t(b);
    }
  }
  return arm;
}

JoinedHands::Grip JoinedHands::draw(Random& random) const {
  Grip g{};
  // The place lies between the lap and a point above the head, and between the belly and the reach of the
  // arms.
  g.place = {0.25f * random.normal(), random.between(-0.9f, 0.5f), random.between(0.25f, 0.9f)};
  g.handle = normalised(normal3(random) + Vec3{0, 0.6f, 0});
  const float kind = random.unit();
  const int inner = random.chance(0.5f) ? 1 : 0;
  for (int s = 0; s < 2; ++s) {
    g.apart[s] = random.between(0.25f, 0.6f);
    g.along[s] = 0.25f * random.normal();
    g.miss[s] = 0.25f * normal3(random);
    g.thumb[s] = random.chance(0.9f) ? 1.0f : -1.0f;
    g.aim[s] = 0.35f * normal3(random);
    g.elbow[s] = 0.4f * normal3(random);
    g.curl[s] = 0.85f + 0.15f * random.normal();
  }
  if (kind < 0.45f) {  // one hand around the other hand
    g.apart[1 - inner] = random.between(0.5f, 1.1f);
    g.curl[1 - inner] = 0.65f + 0.2f * random.normal();
  } else if (kind < 0.8f) {  // one hand behind the other on a handle
    g.along[inner] += 0.5f * random.between(0.7f, 1.4f);
    g.along[1 - inner] -= 0.5f * random.between(0.7f, 1.4f);
  } else {  // flat hands that face each other
    for (int s = 0; s < 2; ++s) {
      g.apart[s] = random.between(0.1f, 0.4f);
      g.curl[s] = 0.15f + 0.15f * random.normal();
    }
  }
  g.pronation = random.between(0.4f, 0.9f);
  return g;
}

JoinedHands::ArmPose JoinedHands::solve(const Pose& pose, const Grip& grip, int s) const {
  const Arm& arm = arms_[s];
  const Mat3x4 chest = chest_ >= 0 ? turn_part(pose[std::size_t(chest_)]) : Mat3x4{};
  const auto in_chest = [&](Vec3 v) {
    return transform_vector(chest, v.x * frame_.left + v.y * frame_.up + v.z * frame_.forward);
  };
  const auto posed_joint = [&](int side) {
    return transform_point(pose[std::size_t(arms_[side].upper)], arms_[side].shoulder);
  };
  const Vec3 shoulder = posed_joint(s);
  const float upper = length(arm.elbow - arm.shoulder), fore = length(arm.wrist - arm.elbow);
  const float hand = length(arm.frame.knuckles - arm.wrist);
  const Vec3 place = 0.5f * (posed_joint(0) + posed_joint(1)) + (upper + fore) * in_chest(grip.place);

  const Vec3 handle = in_chest(grip.handle), across = grip.thumb[s] * handle;
  const Vec3 aim = normalised(place - shoulder) + in_chest(grip.aim[s]);
  const Vec3 along = normalised(beside(aim, handle));
  const float sense = dot(cross(arm.frame.across, arm.frame.along), arm.frame.palm) < 0 ? -1.0f : 1.0f;
  const Vec3 palm = sense * cross(across, along);
  ArmPose result;
  result.hand = frame_turn({arm.frame.along, arm.frame.across, arm.frame.palm}, {along, across, palm});
  const Vec3 knuckles = place + hand * (grip.along[s] * handle - grip.apart[s] * palm + grip.miss[s]);
  const Vec3 wrist = knuckles - transform_vector(result.hand, arm.frame.knuckles - arm.wrist);

  // Two-bone inverse kinematics between shoulder and wrist. Elbows point down, outwards and back.
  const float distance = length(wrist - shoulder);
  result.reaches = distance < 0.985f * (upper + fore) && distance > 1.1f * std::fabs(upper - fore) + 1e-6f;
  const float least = std::fabs(upper - fore), most = upper + fore;
  const float d = std::clamp(distance, least + 0.02f * most, 0.985f * most);
  const Vec3 axis = normalised(wrist - shoulder);
  const float outwards = s == 0 ? 1.0f : -1.0f;
  const Vec3 pole = normalised(beside(in_chest(Vec3{0.6f * outwards, -1, -0.3f} + grip.elbow[s]), axis));
  const float x = (d * d + upper * upper - fore * fore) / (2 * d);
  const float y = std::sqrt(std::max(0.0f, upper * upper - x * x));
  const Vec3 elbow = shoulder + x * axis + y * pole, end = shoulder + d * axis;

  const Mat3x4 was = turn_part(pose[std::size_t(arm.upper)]);
  const auto towards = [](const Mat3x4& turn, Vec3 rest, Vec3 wish) {
    return rotation(shortest_arc(transform_vector(turn, normalised(rest)), normalised(wish))) * turn;
  };
  result.upper = towards(was, arm.elbow - arm.shoulder, elbow - shoulder);
  result.fore = towards(result.upper, arm.wrist - arm.elbow, end - elbow);
  const Vec3 forearm = normalised(end - elbow);
  const float twist = twist_about(result.hand * inverse_rigid(result.fore), forearm);
  result.fore = rotation(grip.pronation * twist * forearm) * result.fore;
  result.straightness = dot(along, forearm);
  return result;
}

void JoinedHands::close_fingers(const Arm& arm, float curl, std::vector<JointMotion>& motions,
                                Random& random) const {
  const float thumb = random.unit();
  // In this share of poses, the index finger is stretched: it points or is on a trigger.
  const bool stretched = random.chance(0.25f);
  const float index = random.between(-0.05f, 0.5f);
  for (const std::uint32_t b : arm.fingers) {
    const bool is_index =
        b == std::uint32_t(arm.index_knuckle) || is_below(tree_, b, std::size_t(arm.index_knuckle));
    const float own = (stretched && is_index ? index : curl) + 0.15f * random.normal();
    motions[b].turn =
        joints_[b].role == JointRole::thumb
            ? thumb * std::max(0.2f, curl) * 40 * degree * curl_axis_[b] + 0.08f * normal3(random)
            : finger_turn(joints_[b], curl_axis_[b], own);
  }
}

void JoinedHands::join(std::vector<JointMotion>& motions, bool with_fingers, Random& random) const {
  // Clavicles that carry the upper arms keep their rest pose.
  for (const Arm& arm : arms_) motions[std::size_t(arm.upper)].turn = {};
  const Pose pose = pose_of(mesh_, tree_, motions);
  constexpr int tries = 12;
  const float least_straight = std::cos(70 * degree);
  Grip best{};
  float least = INFINITY;
  for (int t = 0; t < tries && least > 0; ++t) {
    const Grip grip = draw(random);
    float fault = 0;
    for (int s = 0; s < 2; ++s) {
      const ArmPose arm = solve(pose, grip, s);
      fault += (arm.reaches ? 0.0f : 1.0f) + std::max(0.0f, least_straight - arm.straightness);
    }
    if (fault < least) {
      least = fault;
      best = grip;
    }
  }
  for (int s = 0; s < 2; ++s) {
    const Arm& arm = arms_[s];
    const ArmPose wish = solve(pose, best, s);
    // A joint's turn is relative to its parent. Other joints may lie between upper arm, forearm and hand.
    const auto set = [&](std::int32_t bone, const Mat3x4& turn) {
      const Pose now = pose_of(mesh_, tree_, motions);
      const std::int32_t parent = tree_.parent[std::size_t(bone)];
      const Mat3x4 above = parent >= 0 ? turn_part(now[std::size_t(parent)]) : Mat3x4{};
      motions[std::size_t(bone)].turn = turn_of(inverse_rigid(above) * turn);
    };
    set(arm.upper, wish.upper);
    set(arm.fore, wish.fore);
    set(arm.hand, wish.hand);
    if (with_fingers) close_fingers(arm, best.curl[s], motions, random);
  }
}

}  // namespace nook::bake
