// Whole-body poses of people, drawn from statistics of motion capture (pose_prior.py), independent of a rig.
#pragma once

#include "bakers/raytrace/random.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Axes are left, up and forward, those of the chest for arms and those of the pelvis for legs.
struct PriorLimbs {
  Vec3 upper_arm, forearm, hand, thigh, calf, foot;  // directions, unit length
};
struct PriorPose {
  Vec3 chest;           // turn of the chest against the pelvis: axis times angle, radians
  Vec3 head;            // the same of the head against the chest
  PriorLimbs limbs[2];  // left, right
};

PriorPose prior_pose(Random& random);

}  // namespace nook::bake
