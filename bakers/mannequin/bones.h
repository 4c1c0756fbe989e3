#pragma once

#include <glm/gtc/quaternion.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/mannequin/shape_primitives.h"

namespace nook::mannequin {

using Quat = glm::dquat;

struct Bone {
  std::string name;
  int parent;       ///< Index of the parent, -1 for the root. Parents come before their children.
  Vec3 position_m;  ///< Position of the joint in the bind pose, model space.
  Vec3 tip_m;  ///< Where the bone ends: the joint of its main child. For a bone without children, the end of
               ///< the flesh.
  Quat orientation;  ///< Bind orientation in model space. The bone's y axis runs along the bone.
};

/// The bind pose: feet on y = 0, facing +z, the character's left at +x, arms 45 degrees down, palms inwards.
class Skeleton {
 public:
  Skeleton();

  const std::vector<Bone>& bones() const { return bones_; }
  std::size_t size() const { return bones_.size(); }
  /// Throws std::out_of_range if no bone has this name.
  int find(std::string_view name) const;
  const Bone& bone(std::string_view name) const { return bones_[static_cast<std::size_t>(find(name))]; }

 private:
  void add(std::string name, std::string_view parent, const Vec3& position_m, const Vec3& tip_m);
  void add_arm(const std::string& side, double sign);
  void add_leg(const std::string& side, double sign);

  std::vector<Bone> bones_;
};

/// Joints and directions of the left arm in the bind pose. The right arm is mirrored in x.
struct ArmFrame {
  Vec3 shoulder_m, elbow_m, wrist_m;
  Vec3 along;    ///< From the shoulder to the finger tips.
  Vec3 forward;  ///< Towards the thumb's side. The elbow bends in this direction.
  Vec3 outward;  ///< Towards the back of the hand.
};
ArmFrame left_arm_frame();

/// Points of the left leg in the bind pose. The sole ends at the heel and the toe, and bends at the ball.
struct LegFrame {
  Vec3 hip_m, knee_m, ankle_m, heel_m, ball_m, toe_m;
};
LegFrame left_leg_frame();

/// One finger of the left hand: four points from knuckle to tip, and the finger's radius at each.
struct FingerChain {
  const char* name;
  Vec3 joints_m[4];
  double radii_m[4];
};
/// Returns thumb, index, middle, ring and little finger, in this order.
const std::vector<FingerChain>& left_fingers();

}  // namespace nook::mannequin
