// One pose of a body apart from any rig: random turns within the ranges and couplings of the human body.
#pragma once

#include <numbers>
#include <random>

#include "bakers/raytrace/random.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Whole-body poses of people, drawn from statistics of motion capture (pose_prior.py), independent of a rig.

// Axes are left, up and forward: of the chest for arms, of the pelvis for legs.
struct PriorLimbs {
  Vec3 upper_arm, forearm, hand, thigh, calf, foot;  // directions, unit length
};
struct PriorPose {
  Vec3 chest;           // turn of the chest against the pelvis: axis times angle, radians
  Vec3 head;            // the same of the head against the chest
  PriorLimbs limbs[2];  // left, right
};

PriorPose prior_pose(Random& random);

constexpr float degree = std::numbers::pi_v<float> / 180;

using PoseRandom = RandomFrom<std::mt19937_64>;

Vec3 normal3(PoseRandom& random);  // each coordinate N(0, 1)

// The motion of the limbs of one side in one pose; angles in radians.
struct LimbPlan {
  Vec3 arm_direction;  // of the upper arm, body frame axes (left, up, forward), mirrored for the right side
  float arm_twist, elbow, hip_flexion, hip_abduction, hip_twist, knee, ankle, toe, curl, thumb;
  Vec3 elbow_lean;  // random part of the direction to which the elbow bends
  Vec3 clavicle, hand;
};

struct BodyPlan {
  LimbPlan limb[2];          // left, right
  float bend, lean, twist;   // of the whole spine, radians
  float shoulder_share = 1;  // of the swing of an arm, of a clavicle that carries it (auto_poses.cpp)
  Vec3 neck;
  // A pose of motion capture, and the parts of the body that take it in place of the plan above.
  PriorPose motion;
  bool trunk_of_motion = false, arms_of_motion = false, legs_of_motion = false;
};

// Draws what an arm does anew: hanging, reaching forwards, raised to the side or overhead.
void plan_arm(LimbPlan& plan, PoseRandom& random);

// Nothing of it follows motion capture.
BodyPlan plan_body(PoseRandom& random);

}  // namespace nook::bake
