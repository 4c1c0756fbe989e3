#include "bakers/mannequin/bones.h"

#include <cmath>
#include <stdexcept>

namespace nook::mannequin {
namespace {

constexpr double upper_arm_m = 0.285;
constexpr double forearm_m = 0.250;

struct FingerPlan {
  const char* name;
  double along_m, forward_m, outward_m;  ///< Position of the knuckle, relative to the wrist.
  double fan_deg;                        ///< Angle towards the thumb's side.
  double dip_deg;                        ///< Angle towards the palm at the knuckle.
  double bend_deg;                       ///< Relaxed bend at each of the other joints.
  double lengths_m[3];
  double radii_m[4];
};

constexpr FingerPlan plans[] = {
    {"thumb", 0.024, 0.022, -0.010, 44.0, 18.0, 9.0, {0.043, 0.033, 0.022}, {0.0145, 0.0112, 0.0100, 0.0080}},
    {"index", 0.089, 0.0315, 0.001, 9.0, 4.0, 8.0, {0.043, 0.026, 0.017}, {0.0095, 0.0085, 0.0077, 0.0064}},
    {"middle", 0.092, 0.0105, 0.002, 2.0, 4.0, 8.0, {0.047, 0.030, 0.018}, {0.0097, 0.0087, 0.0079, 0.0065}},
    {"ring", 0.088, -0.0105, 0.001, -5.0, 5.0, 9.0, {0.044, 0.028, 0.018}, {0.0093, 0.0082, 0.0075, 0.0062}},
    {"pinky",
     0.080,
     -0.0310,
     -0.001,
     -13.0,
     7.0,
     9.0,
     {0.035, 0.021, 0.016},
     {0.0083, 0.0072, 0.0066, 0.0055}},
};

FingerChain make_finger(const FingerPlan& plan) {
  const ArmFrame arm = left_arm_frame();
  FingerChain finger{};
  finger.name = plan.name;
  finger.joints_m[0] =
      arm.wrist_m + arm.along * plan.along_m + arm.forward * plan.forward_m + arm.outward * plan.outward_m;
  const double fan = glm::radians(plan.fan_deg);
  const Vec3 straight = arm.along * std::cos(fan) + arm.forward * std::sin(fan);
  double dip_deg = plan.dip_deg;
  for (int i = 0; i < 3; ++i) {
    const double dip = glm::radians(dip_deg);
    const Vec3 direction = straight * std::cos(dip) - arm.outward * std::sin(dip);
    finger.joints_m[i + 1] = finger.joints_m[i] + direction * plan.lengths_m[i];
    dip_deg += plan.bend_deg;
  }
  for (int i = 0; i < 4; ++i) {
    finger.radii_m[i] = plan.radii_m[i];
  }
  return finger;
}

}  // namespace

ArmFrame left_arm_frame() {
  const double half = std::sqrt(0.5);
  ArmFrame arm{};
  arm.along = Vec3(half, -half, 0.0);
  arm.forward = Vec3(0.0, 0.0, 1.0);
  arm.outward = Vec3(half, half, 0.0);
  arm.shoulder_m = Vec3(0.187, 1.424, -0.022);
  arm.elbow_m = arm.shoulder_m + arm.along * upper_arm_m;
  arm.wrist_m = arm.elbow_m + arm.along * forearm_m;
  return arm;
}

LegFrame left_leg_frame() {
  return {.hip_m = {0.092, 0.915, -0.008},
          .knee_m = {0.104, 0.490, 0.000},
          .ankle_m = {0.112, 0.085, -0.030},
          .heel_m = {0.105, 0.000, -0.085},
          .ball_m = {0.127, 0.022, 0.085},
          .toe_m = {0.136, 0.016, 0.155}};
}

const std::vector<FingerChain>& left_fingers() {
  static const std::vector<FingerChain> fingers = [] {
    std::vector<FingerChain> made;
    for (const FingerPlan& plan : plans) {
      made.push_back(make_finger(plan));
    }
    return made;
  }();
  return fingers;
}

Skeleton::Skeleton() {
  add("root", "", Vec3(0.0), Vec3(0.0, 0.1, 0.0));
  add("pelvis", "root", Vec3(0.0, 0.955, -0.010), Vec3(0.0, 1.050, -0.010));
  add("spine_01", "pelvis", Vec3(0.0, 1.050, -0.010), Vec3(0.0, 1.165, -0.012));
  add("spine_02", "spine_01", Vec3(0.0, 1.165, -0.012), Vec3(0.0, 1.285, -0.025));
  add("spine_03", "spine_02", Vec3(0.0, 1.285, -0.025), Vec3(0.0, 1.470, -0.035));
  add("neck_01", "spine_03", Vec3(0.0, 1.470, -0.035), Vec3(0.0, 1.562, -0.008));
  add("head", "neck_01", Vec3(0.0, 1.562, -0.008), Vec3(0.0, 1.750, -0.008));
  add_arm("_l", 1.0);
  add_arm("_r", -1.0);
  add_leg("_l", 1.0);
  add_leg("_r", -1.0);
}

int Skeleton::find(std::string_view name) const {
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    if (bones_[i].name == name) {
      return static_cast<int>(i);
    }
  }
  throw std::out_of_range("Skeleton::find: no bone is called '" + std::string(name) + "'");
}

void Skeleton::add(std::string name, std::string_view parent, const Vec3& position_m, const Vec3& tip_m) {
  // The bone's z axis points as far forward as its y axis allows. If the bone itself points forward, z points
  // up instead.
  const Vec3 along = glm::normalize(tip_m - position_m);
  const Vec3 hint = std::abs(along.z) > 0.8 ? Vec3(0.0, 1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  const Mat3 frame = axes_from(along, hint);
  const Mat3 axes(glm::cross(frame[0], frame[1]), frame[0], frame[1]);
  bones_.push_back(
      {std::move(name), parent.empty() ? -1 : find(parent), position_m, tip_m, glm::quat_cast(axes)});
}

void Skeleton::add_arm(const std::string& side, double sign) {
  const Vec3 mirror(sign, 1.0, 1.0);
  const ArmFrame arm = left_arm_frame();
  const Vec3 mid_upper = (arm.shoulder_m + arm.elbow_m) * 0.5;
  const Vec3 mid_lower = (arm.elbow_m + arm.wrist_m) * 0.5;
  const Vec3 knuckles = arm.wrist_m + arm.along * 0.09;
  add("clavicle" + side, "spine_03", Vec3(0.022, 1.428, 0.020) * mirror, arm.shoulder_m * mirror);
  add("upperarm" + side, "clavicle" + side, arm.shoulder_m * mirror, arm.elbow_m * mirror);
  add("upperarm_twist_01" + side, "upperarm" + side, arm.shoulder_m * mirror, mid_upper * mirror);
  add("lowerarm" + side, "upperarm" + side, arm.elbow_m * mirror, arm.wrist_m * mirror);
  add("lowerarm_twist_01" + side, "lowerarm" + side, mid_lower * mirror, arm.wrist_m * mirror);
  add("hand" + side, "lowerarm" + side, arm.wrist_m * mirror, knuckles * mirror);
  for (const FingerChain& finger : left_fingers()) {
    std::string parent = "hand" + side;
    for (int i = 0; i < 3; ++i) {
      const std::string name = std::string(finger.name) + "_0" + std::to_string(i + 1) + side;
      add(name, parent, finger.joints_m[i] * mirror, finger.joints_m[i + 1] * mirror);
      parent = name;
    }
  }
}

void Skeleton::add_leg(const std::string& side, double sign) {
  const Vec3 mirror(sign, 1.0, 1.0);
  const LegFrame leg = left_leg_frame();
  add("thigh" + side, "pelvis", leg.hip_m * mirror, leg.knee_m * mirror);
  add("calf" + side, "thigh" + side, leg.knee_m * mirror, leg.ankle_m * mirror);
  add("foot" + side, "calf" + side, leg.ankle_m * mirror, leg.ball_m * mirror);
  add("ball" + side, "foot" + side, leg.ball_m * mirror, leg.toe_m * mirror);
}

}  // namespace nook::mannequin
