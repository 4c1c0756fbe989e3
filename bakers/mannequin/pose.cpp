#include "bakers/mannequin/pose.h"

#include <algorithm>
#include <cmath>

namespace nook::mannequin {

Pose::Pose(const Skeleton& skeleton)
    : skeleton_(&skeleton), turns_(skeleton.size(), Quat(1.0, 0.0, 0.0, 0.0)) {}

void Pose::turn(std::string_view bone, const Vec3& axis, double angle_deg) {
  Quat& q = turns_[static_cast<std::size_t>(skeleton_->find(bone))];
  q = glm::normalize(glm::angleAxis(glm::radians(angle_deg), glm::normalize(axis)) * q);
}

Quat Pose::facing(int bone) const {
  const auto i = static_cast<std::size_t>(bone);
  const int parent = skeleton_->bones()[i].parent;
  return parent < 0 ? turns_[i] : facing(parent) * turns_[i];
}

Vec3 Pose::joint_m(int bone) const {
  const Bone& b = skeleton_->bones()[static_cast<std::size_t>(bone)];
  if (b.parent < 0) {
    return b.position_m;
  }
  const Vec3 shift = b.name == "pelvis" ? pelvis_shift_m_ : Vec3(0.0);
  return carried_m(b.parent, b.position_m + shift);
}

Vec3 Pose::carried_m(int bone, const Vec3& bind_point_m) const {
  const Vec3 offset = bind_point_m - skeleton_->bones()[static_cast<std::size_t>(bone)].position_m;
  return joint_m(bone) + facing(bone) * offset;
}

Quat Pose::local_rotation(int bone) const {
  const auto i = static_cast<std::size_t>(bone);
  const int parent = skeleton_->bones()[i].parent;
  const Quat parent_axes = parent < 0 ? Quat(1.0, 0.0, 0.0, 0.0)
                                      : skeleton_->bones()[static_cast<std::size_t>(parent)].orientation;
  return glm::normalize(glm::conjugate(parent_axes) * turns_[i] * skeleton_->bones()[i].orientation);
}

std::string sided(std::string_view bone, Side side) {
  return std::string(bone) + (side == Side::left ? "_l" : "_r");
}

double sign_of(Side side) {
  return side == Side::left ? 1.0 : -1.0;
}

namespace {

/// When the hand rolls, the middle of the forearm rolls by this share.
constexpr double forearm_share = 0.55;

Vec3 mirrored(const Vec3& v, Side side) {
  return {v.x * sign_of(side), v.y, v.z};
}

/// Returns the rotation that takes one pair of directions to another pair.
Quat between(const Vec3& from_first, const Vec3& from_second, const Vec3& to_first, const Vec3& to_second) {
  return glm::normalize(
      glm::quat_cast(axes_from(to_first, to_second) * glm::transpose(axes_from(from_first, from_second))));
}

Quat about(const Vec3& axis, double angle_deg) {
  return glm::angleAxis(glm::radians(angle_deg), glm::normalize(axis));
}

/// Returns the angle by which a rotation turns about `axis`.
double twist_deg(const Quat& q, const Vec3& axis) {
  const double along = glm::dot(Vec3(q.x, q.y, q.z), axis);
  double degrees = glm::degrees(2.0 * std::atan2(along, q.w));
  if (degrees > 180.0) {
    degrees -= 360.0;
  }
  return degrees < -180.0 ? degrees + 360.0 : degrees;
}

/// Sets the bone's rotation so that it is rotated by `facing` from the bind pose, in model space.
void face(Pose& pose, int bone, const Quat& facing) {
  const int parent = pose.skeleton().bones()[static_cast<std::size_t>(bone)].parent;
  pose.set_turn(bone, glm::normalize(glm::conjugate(pose.facing(parent)) * facing));
}

void turn_collar_bone(Pose& pose, Side side, const ArmPlan& plan) {
  pose.turn(sided("clavicle", side), z_axis, sign_of(side) * plan.shrug_deg);
  pose.turn(sided("clavicle", side), y_axis, -sign_of(side) * plan.reach_deg);
}

void turn_arm(Pose& pose, Side side, const ArmPlan& plan) {
  const Skeleton& skeleton = pose.skeleton();
  const int upper = skeleton.find(sided("upperarm", side)), lower = skeleton.find(sided("lowerarm", side));
  const int upper_twist = skeleton.find(sided("upperarm_twist_01", side));
  const int lower_twist = skeleton.find(sided("lowerarm_twist_01", side)),
            hand = skeleton.find(sided("hand", side));
  const ArmFrame left = left_arm_frame();
  const Vec3 bind_along = mirrored(left.along, side), bind_outward = mirrored(left.outward, side);
  const double s = sign_of(side);

  const Quat chest = pose.facing(skeleton.find("spine_03"));
  const Vec3 along = glm::normalize(mirrored(plan.upper, side));
  const Vec3 bends_to = axes_from(along, mirrored(plan.bends_to, side))[1];
  const Quat upper_facing = chest * between(bind_along, z_axis, along, bends_to);
  face(pose, upper, upper_facing);
  // Relative to the bind pose, the elbow bends the forearm forward, and a roll turns the hand about the
  // forearm.
  pose.set_turn(lower, about(glm::cross(bind_along, z_axis), plan.elbow_deg));
  const Quat roll = about(bind_along, s * plan.roll_deg);
  const Quat half_roll = about(bind_along, s * plan.roll_deg * forearm_share);
  pose.set_turn(lower_twist, half_roll);
  pose.set_turn(hand, glm::normalize(roll * about(glm::cross(bind_along, -bind_outward), plan.wrist_deg)));
  // The skin of the shoulder follows the arm's swing, but only a part of its twist.
  pose.set_turn(upper_twist, about(bind_along, -0.65 * twist_deg(pose.turn_of(upper), bind_along)));
}

void curl_finger(Pose& pose, Side side, std::string_view finger, double knuckle_deg, double other_deg) {
  const ArmFrame left = left_arm_frame();
  for (int i = 1; i <= 3; ++i) {
    const std::string name = sided(std::string(finger) + "_0" + std::to_string(i), side);
    const Bone& bone = pose.skeleton().bone(name);
    const Vec3 along = glm::normalize(bone.tip_m - bone.position_m);
    const Vec3 axis = glm::cross(along, -mirrored(left.outward, side));
    pose.turn(name, axis, i == 1 ? knuckle_deg : other_deg);
  }
}

/// Bends the thumb towards a direction. `towards` is in the axes of the arm frame.
void bend_thumb(Pose& pose, Side side, double root_deg, double other_deg, const Vec3& towards) {
  const ArmFrame left = left_arm_frame();
  const Vec3 way =
      mirrored(left.along * towards.x + left.outward * towards.y + left.forward * towards.z, side);
  for (int i = 1; i <= 3; ++i) {
    const std::string name = sided("thumb_0" + std::to_string(i), side);
    const Bone& bone = pose.skeleton().bone(name);
    pose.turn(name, glm::cross(glm::normalize(bone.tip_m - bone.position_m), way),
              i == 1 ? root_deg : other_deg);
  }
}

}  // namespace

Vec3 bind_ball_m(Side side) {
  const Vec3 joint = left_leg_frame().ball_m;
  return mirrored(Vec3(joint.x, 0.0, joint.z), side);
}

void place_foot(Pose& pose, Side side, const FootPlan& plan) {
  const Skeleton& skeleton = pose.skeleton();
  const int thigh = skeleton.find(sided("thigh", side)), calf = skeleton.find(sided("calf", side));
  const int foot = skeleton.find(sided("foot", side)), ball = skeleton.find(sided("ball", side));
  const auto bind_m = [&](int bone) { return skeleton.bones()[static_cast<std::size_t>(bone)].position_m; };

  // If the heel is up, the foot rolls over its ball. If the toes are up, it rolls over its heel.
  const Quat yaw = about(y_axis, plan.yaw_deg * sign_of(side));
  const Quat pitch = about(x_axis, plan.pitch_deg);
  const Vec3 flat_ball = bind_ball_m(side);
  const Vec3 pivot = plan.pitch_deg > 0.0 ? flat_ball : mirrored(left_leg_frame().heel_m, side);
  const Vec3 rolled = pivot - flat_ball + pitch * (bind_m(foot) - pivot);
  const Vec3 target_ankle = plan.ball_m + yaw * rolled;

  const Vec3 hip = pose.joint_m(thigh);
  const double upper = glm::length(bind_m(calf) - bind_m(thigh)),
               lower = glm::length(bind_m(foot) - bind_m(calf));
  const Vec3 to_ankle = target_ankle - hip;
  // The leg is never fully straight, so that the knee does not snap.
  const double reach = std::clamp(glm::length(to_ankle), 0.25, 0.9985 * (upper + lower));
  const Vec3 down = glm::normalize(to_ankle);
  const Vec3 knee_way = pose.facing(skeleton.find("pelvis")) * mirrored(Vec3(plan.knee_out, 0.0, 1.0), side);
  const Vec3 ahead = axes_from(down, knee_way)[1];
  const double cosine = (upper * upper + reach * reach - lower * lower) / (2.0 * upper * reach);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const Vec3 knee = hip + (down * cosine + ahead * sine) * upper;
  const Vec3 ankle = hip + down * reach;

  face(pose, thigh, between(bind_m(calf) - bind_m(thigh), z_axis, knee - hip, ahead));
  // The front of the calf keeps in line with the front of the thigh, however far the knee bends.
  const Vec3 hinge = glm::cross(down, ahead);
  face(pose, calf,
       between(bind_m(foot) - bind_m(calf), z_axis, ankle - knee,
               glm::cross(hinge, glm::normalize(ankle - knee))));
  face(pose, foot, glm::normalize(yaw * pitch));
  pose.set_turn(ball, about(x_axis, -std::max(plan.pitch_deg, 0.0)));
}

void place_arm(Pose& pose, Side side, const ArmPlan& plan) {
  turn_collar_bone(pose, side, plan);
  turn_arm(pose, side, plan);
}

void place_hand(Pose& pose, Side side, const ReachPlan& plan) {
  const Skeleton& skeleton = pose.skeleton();
  const ArmFrame left = left_arm_frame();
  const Vec3 bind_along = mirrored(left.along, side), bind_outward = mirrored(left.outward, side);
  ArmPlan arm;
  arm.shrug_deg = plan.shrug_deg;
  arm.reach_deg = plan.reach_deg;
  turn_collar_bone(pose, side, arm);

  const Vec3 shoulder = pose.joint_m(skeleton.find(sided("upperarm", side)));
  const double upper = glm::length(left.elbow_m - left.shoulder_m),
               lower = glm::length(left.wrist_m - left.elbow_m);
  const Vec3 to_ankle = plan.wrist_m - shoulder;
  const double reach = std::clamp(glm::length(to_ankle), 0.15, 0.995 * (upper + lower));
  const Vec3 away = glm::normalize(to_ankle);
  const Vec3 elbow_to = axes_from(away, plan.elbow_to)[1];
  const double cosine = (upper * upper + reach * reach - lower * lower) / (2.0 * upper * reach);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const Vec3 upper_way = away * cosine + elbow_to * sine;
  const Vec3 lower_way = (away * reach - upper_way * upper) / lower;

  // Directions of an ArmPlan are relative to the chest, and +x is outwards on both sides.
  const Quat to_chest = glm::conjugate(pose.facing(skeleton.find("spine_03")));
  arm.upper = mirrored(to_chest * upper_way, side);
  arm.bends_to = mirrored(to_chest * lower_way, side);
  arm.elbow_deg = glm::degrees(std::acos(std::clamp(glm::dot(upper_way, lower_way), -1.0, 1.0)));
  turn_arm(pose, side, arm);

  const Quat hand = glm::conjugate(pose.facing(skeleton.find(sided("lowerarm", side)))) *
                    between(bind_along, bind_outward, plan.fingers_to, plan.back_of_hand);
  pose.set_turn(skeleton.find(sided("hand", side)), glm::normalize(hand));
  pose.set_turn(skeleton.find(sided("lowerarm_twist_01", side)),
                about(bind_along, forearm_share * twist_deg(hand, bind_along)));
}

void curl_fingers(Pose& pose, Side side, double fingers_deg, double thumb_deg) {
  for (const char* finger : {"index", "middle", "ring", "pinky"}) {
    curl_finger(pose, side, finger, fingers_deg, fingers_deg);
  }
  bend_thumb(pose, side, 0.6 * thumb_deg, thumb_deg, Vec3(0.0, -0.8, -0.75));
}

void make_fist(Pose& pose, Side side) {
  close_fingers(pose, side, 1.0);
  for (const char* finger : {"index", "middle", "ring", "pinky"}) {
    curl_finger(pose, side, finger, 76.0, 80.0);
  }
  // Swings the base of the thumb under the palm, then folds the thumb over the curled fingers.
  bend_thumb(pose, side, 42.0, 0.0, Vec3(0.0, -0.8, -0.8));
  bend_thumb(pose, side, 0.0, 34.0, Vec3(0.0, 0.0, -1.0));
}

void close_fingers(Pose& pose, Side side, double amount) {
  const Vec3 axis = mirrored(left_arm_frame().outward, side);
  const double s = sign_of(side) * amount;
  pose.turn(sided("index_01", side), axis, s * 7.0);
  pose.turn(sided("ring_01", side), axis, s * -6.0);
  pose.turn(sided("pinky_01", side), axis, s * -13.0);
}

}  // namespace nook::mannequin
