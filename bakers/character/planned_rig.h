// Turns of a rig's joints by a plan, in rest-space axes round each joint's origin, parents first.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bakers/character/body_frame.h"
#include "bakers/character/body_plan.h"
#include "bakers/character/body_tree.h"
#include "bakers/character/hands.h"

namespace nook::bake {

class PlannedRig {
 public:
  explicit PlannedRig(const SkinnedMesh& mesh);  // which is kept by reference

  // Lets a hand reach for a place on the body or for the other hand: what hands come near is what shadows of
  // hands and on hands depend on, and arms that swing freely are seldom there. Of some arms the one that
  // comes nearest is taken.
  void reach(BodyPlan& plan, PoseRandom& random) const;

  Pose pose(const BodyPlan& plan, PoseRandom& random) const;

 private:
  Vec3 in_body(Vec3 v) const { return v.x * frame_.left + v.y * frame_.up + v.z * frame_.forward; }
  Vec3 joint_turn(std::size_t bone, const BodyPlan& plan, PoseRandom& random) const;
  void place_arms(const BodyPlan& plan, std::vector<Mat3x4>& local) const;
  void place_limbs_of_motion(const BodyPlan& plan, std::vector<Mat3x4>& local) const;

  const SkinnedMesh& mesh_;
  std::vector<Joint> joints_;
  BodyTree tree_;
  BodyFrame frame_;
  std::vector<char> posable_;
  std::vector<Vec3> curl_axis_;
  std::array<BodyPoint, 2> palm_;  // left, right
  std::size_t spine_count_ = 1, neck_count_ = 1;
};

}  // namespace nook::bake
