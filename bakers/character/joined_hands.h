// Makes poses in which both hands hold one object or each other, for example in a grip or a prayer. Most uses
// of tools and weapons and many gestures look like this. Arms whose poses are chosen independently never come
// so close to each other.
#pragma once

#include <array>
#include <vector>

#include "bakers/character/hands.h"
#include "bakers/character/joint_motion.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/raytrace/random.h"

namespace nook::bake {

class JoinedHands {
 public:
  // Keeps a reference to the mesh.
  explicit JoinedHands(const SkinnedMesh& mesh, const RigCorrections& corrections = {});

  // Returns false if the rig does not have two arms with hands and fingers.
  bool possible() const { return arms_[0].index_knuckle >= 0 && arms_[1].index_knuckle >= 0; }

  // Picks a random place in front of the trunk and moves both hands there. If with_fingers is true, also
  // closes the fingers. The other joints do not move. Call this only if possible() returns true.
  void join(std::vector<JointMotion>& motions, bool with_fingers, Random& random) const;

 private:
  struct Arm {
    std::int32_t upper = -1, fore = -1, hand = -1;  // bones
    Vec3 shoulder, elbow, wrist;                    // joints at rest, metres
    HandFrame frame;
    std::vector<std::uint32_t> fingers;  // with thumbs, without those that hold an object; parents first
    std::int32_t index_knuckle = -1;     // the first joint of the finger beside the thumb
  };
  struct Grip;
  struct ArmPose;

  Arm find_arm(Side side) const;
  Grip draw(Random& random) const;
  ArmPose solve(const Pose& pose, const Grip& grip, int side) const;
  void close_fingers(const Arm& arm, float curl, std::vector<JointMotion>& motions, Random& random) const;

  const SkinnedMesh& mesh_;
  std::vector<Joint> joints_;
  BodyTree tree_;
  BodyFrame frame_;
  std::vector<Vec3> curl_axis_;
  std::array<Arm, 2> arms_;  // left, right
  std::int32_t chest_ = -1;  // the nearest bone above both arms in the hierarchy; -1: none
};

}  // namespace nook::bake
