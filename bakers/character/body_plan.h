// Describes one pose of a human body independently of any rig. The turns of the joints are random, within the
// ranges and couplings of the human body.
#pragma once

#include <numbers>
#include <random>

#include "bakers/raytrace/random.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Whole-body poses of people, drawn from statistics of motion capture (pose_prior.py), independent of a rig.

// Axes are left, up and forward. Arms use the axes of the chest, legs use the axes of the pelvis.
struct PriorLimbs {
  Vec3 upper_arm, forearm, hand, thigh, calf, foot;  // directions, unit length
};
struct PriorPose {
  Vec3 chest;           // turn of the chest relative to the pelvis: axis times angle, radians
  Vec3 head;            // turn of the head relative to the chest, in the same form
  PriorLimbs limbs[2];  // left, right
};

PriorPose prior_pose(Random& random);

constexpr float degree = std::numbers::pi_v<float> / 180;

using PoseRandom = RandomFrom<std::mt19937_64>;

Vec3 normal3(PoseRandom& random);  // each coordinate is drawn from N(0, 1)

// The motion of the limbs of one side in one pose; angles in radians.
struct LimbPlan {
  Vec3 arm_direction;  // direction of the upper arm in the axes of the body frame (left, up, forward);
                       // mirrored for the right side
  float arm_twist, elbow, hip_flexion, hip_abduction, hip_twist, knee, ankle, toe, curl, thumb;
  Vec3 elbow_lean;  // random part of the direction in which the elbow bends
  Vec3 clavicle, hand;
};

struct BodyPlan {
  LimbPlan limb[2];          // left, right
  float bend, lean, twist;   // angles of the whole spine, radians
  float shoulder_share = 1;  // the clavicle's share of an arm's swing, if it carries the arm (auto_poses.cpp)
  Vec3 neck;
  // A pose from motion capture, and the parts of the body that use it instead of the plan above.
  PriorPose motion;
  bool trunk_of_motion = false, arms_of_motion = false, legs_of_motion = false;
};

// Chooses at random what an arm does: it hangs, reaches forwards, or is raised to the side or overhead.
void plan_arm(LimbPlan& plan, PoseRandom& random);

// No part of the returned plan uses motion capture.
BodyPlan plan_body(PoseRandom& random);

}  // namespace nook::bake
