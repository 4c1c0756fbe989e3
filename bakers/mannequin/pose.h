#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/mannequin/bones.h"

namespace nook::mannequin {

/// A side of the body. Left is +x. Selects one of the two arms, legs and so on.
enum class Side { left, right };

/// A pose: for each bone, a rotation from the bind pose. The rotation is relative to the parent bone, but its
/// axes are the axes of the model, so that you can describe motions in terms of the body.
class Pose {
 public:
  explicit Pose(const Skeleton& skeleton);

  void shift_pelvis(const Vec3& offset_m) { pelvis_shift_m_ += offset_m; }
  const Vec3& pelvis_shift_m() const { return pelvis_shift_m_; }

  /// Adds a rotation about a model axis. A positive angle about x bends forwards, about y turns to the left,
  /// and about z leans to the right.
  void turn(std::string_view bone, const Vec3& axis, double angle_deg);
  void set_turn(int bone, const Quat& turn) { turns_[static_cast<std::size_t>(bone)] = turn; }
  const Quat& turn_of(int bone) const { return turns_[static_cast<std::size_t>(bone)]; }

  /// Returns the bone's rotation from the bind pose in model space, including the rotations of all parents.
  Quat facing(int bone) const;
  Vec3 joint_m(int bone) const;
  /// Returns where a point that is attached to the bone is in this pose. `bind_point_m` is its position in
  /// the bind pose.
  Vec3 carried_m(int bone, const Vec3& bind_point_m) const;

  /// Returns the rotation relative to the parent in the bones' own axes, as glTF stores it.
  Quat local_rotation(int bone) const;

  const Skeleton& skeleton() const { return *skeleton_; }

 private:
  const Skeleton* skeleton_;
  std::vector<Quat> turns_;
  Vec3 pelvis_shift_m_{0.0};
};

/// Returns the bone's name with the suffix of the side.
std::string sided(std::string_view bone, Side side);
/// Returns +1 for the left side, -1 for the right side.
double sign_of(Side side);

/// Where a foot stands. The plan first describes a flat foot. The foot then rolls over its heel or its ball,
/// so that it cannot sink into the ground.
struct FootPlan {
  Vec3 ball_m;             ///< The point under the ball of the foot; y is the sole's height above the ground.
  double yaw_deg = 0.0;    ///< Turns the toes outwards, in addition to the turn in the bind pose.
  double pitch_deg = 0.0;  ///< Positive lifts the heel and keeps the toes down; negative lifts the toes.
  double knee_out = 0.0;   ///< How far the knee points sideways, relative to how far it points forwards.
};
/// Turns thigh, calf, foot and toes so that the foot stands as planned. If the place is out of reach, the
/// foot comes as close as possible.
void place_foot(Pose& pose, Side side, const FootPlan& plan);
/// Returns the value of `ball_m` that describes the bind pose.
Vec3 bind_ball_m(Side side);

/// Where an arm points. Directions are relative to the chest. Outwards is away from the middle of the body.
struct ArmPlan {
  Vec3 upper;               ///< Direction of the upper arm: x outwards, y up, z forward.
  Vec3 bends_to;            ///< The direction in which the elbow bends the forearm.
  double elbow_deg = 10.0;  ///< Zero is straight.
  double roll_deg = 0.0;    ///< Turns the palm: positive turns it backwards and down, negative turns it up.
  double wrist_deg = 0.0;   ///< Positive bends towards the palm.
  double shrug_deg = 0.0;   ///< Raises the collar bone.
  double reach_deg = 0.0;   ///< Moves the collar bone forward.
};
void place_arm(Pose& pose, Side side, const ArmPlan& plan);

/// Where a hand is placed, in model space.
struct ReachPlan {
  Vec3 wrist_m;
  Vec3 elbow_to;      ///< The direction in which the elbow points.
  Vec3 fingers_to;    ///< Direction of the straight fingers.
  Vec3 back_of_hand;  ///< Direction in which the back of the hand faces.
  double shrug_deg = 0.0;
  double reach_deg = 0.0;
};
/// Turns the arm so that the hand is placed as planned. If the place is out of reach, the hand comes as close
/// as possible.
void place_hand(Pose& pose, Side side, const ReachPlan& plan);

/// Curls the four fingers by `fingers_deg` at each joint, and the thumb by `thumb_deg`.
void curl_fingers(Pose& pose, Side side, double fingers_deg, double thumb_deg);
void make_fist(Pose& pose, Side side);
/// Moves the fingers together; they are spread in the bind pose. At an `amount` of 1, they are parallel.
void close_fingers(Pose& pose, Side side, double amount);

}  // namespace nook::mannequin
