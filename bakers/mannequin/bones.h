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
  int parent;        ///< Index of the parent, -1 at the root. Parents come before their children.
  Vec3 position_m;   ///< Joint in the bind pose, model space.
  Vec3 tip_m;        ///< Where the bone ends: its main child's joint, or the end of the flesh at a leaf.
  Quat orientation;  ///< Bind orientation in model space: y runs along the bone.
};

/// The bind pose: feet on y = 0, facing +z, the character's left at +x, arms 45 degrees down, palms inwards.
class Skeleton {
 public:
  Skeleton();

  const std::vector<Bone>& bones() const { return bones_; }
  std::size_t size() const { return bones_.size(); }
  /// Throws std::out_of_range if there is no such name.
  int find(std::string_view name) const;
  const Bone& bone(std::string_view name) const { return bones_[static_cast<std::size_t>(find(name))]; }

 private:
  void add(std::string name, std::string_view parent, const Vec3& position_m, const Vec3& tip_m);
  void add_arm(const std::string& side, double sign);
  void add_leg(const std::string& side, double sign);

  std::vector<Bone> bones_;
};

/// Directions of the left arm in the bind pose; the right one is their mirror image in x.
struct ArmFrame {
  Vec3 shoulder_m, elbow_m, wrist_m;
  Vec3 along;    ///< From the shoulder to the finger tips.
  Vec3 forward;  ///< The thumb's side, and where the elbow bends to.
  Vec3 outward;  ///< The back of the hand.
};
ArmFrame left_arm_frame();

/// Points of the left leg in the bind pose; heel, ball and toe mark where the sole ends and bends.
struct LegFrame {
  Vec3 hip_m, knee_m, ankle_m, heel_m, ball_m, toe_m;
};
LegFrame left_leg_frame();

/// The joints of one left finger from knuckle to tip, four points, and its radii there.
struct FingerChain {
  const char* name;
  Vec3 joints_m[4];
  double radii_m[4];
};
/// Thumb, index, middle, ring, pinky.
const std::vector<FingerChain>& left_fingers();

}  // namespace nook::mannequin
