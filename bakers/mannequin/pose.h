#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/mannequin/bones.h"

namespace nook::mannequin {

/// A side of the body; left is +x. It addresses everything that exists twice.
enum class Side { left, right };

/// A pose, as rotations away from the bind pose. The rotation of a bone is relative to its parent. It is
/// about the model's axes and not the bone's own ones, so that motion can be described in terms of the body.
class Pose {
 public:
  explicit Pose(const Skeleton& skeleton);

  void shift_pelvis(const Vec3& offset_m) { pelvis_shift_m_ += offset_m; }
  const Vec3& pelvis_shift_m() const { return pelvis_shift_m_; }

  /// Adds a rotation about a model axis. Positive angles bend forward about x, turn to the left about y and
  /// lean to the right about z.
  void turn(std::string_view bone, const Vec3& axis, double angle_deg);
  void set_turn(int bone, const Quat& turn) { turns_[static_cast<std::size_t>(bone)] = turn; }
  const Quat& turn_of(int bone) const { return turns_[static_cast<std::size_t>(bone)]; }

  /// The model-space rotation away from the bind pose, which has the rotations of all parents.
  Quat facing(int bone) const;
  Vec3 joint_m(int bone) const;
  /// The present place of a point that is fixed to the bone and given in the bind pose.
  Vec3 carried_m(int bone, const Vec3& bind_point_m) const;

  /// Rotation relative to the parent in the bones' own axes, as glTF stores it.
  Quat local_rotation(int bone) const;

  const Skeleton& skeleton() const { return *skeleton_; }

 private:
  const Skeleton* skeleton_;
  std::vector<Quat> turns_;
  Vec3 pelvis_shift_m_{0.0};
};

/// The bone's name with the side's suffix.
std::string sided(std::string_view bone, Side side);
/// +1 on the left, -1 on the right.
double sign_of(Side side);

/// Where a foot stands. The plan describes a flat foot, which then rolls over its heel or its ball, so that
/// it cannot sink into the ground.
struct FootPlan {
  Vec3 ball_m;             ///< Under the ball of the foot; y is the height of the sole over the ground.
  double yaw_deg = 0.0;    ///< Toes outwards, beyond the bind pose's own turn.
  double pitch_deg = 0.0;  ///< Positive lifts the heel and keeps the toes down; negative lifts the toes.
  double knee_out = 0.0;   ///< How far the knee points sideways for each step that it points ahead.
};
/// Turns thigh, calf, foot and toes so that the foot stands as planned, or as near as the leg reaches.
void place_foot(Pose& pose, Side side, const FootPlan& plan);
/// The `ball_m` that a plan has in the bind pose.
Vec3 bind_ball_m(Side side);

/// Where an arm goes. Directions are relative to the chest, and outwards is away from the middle of the body.
struct ArmPlan {
  Vec3 upper;               ///< Direction of the upper arm: x outwards, y up, z ahead.
  Vec3 bends_to;            ///< Where the elbow takes the forearm.
  double elbow_deg = 10.0;  ///< Zero is straight.
  double roll_deg = 0.0;    ///< Turns the palm: positive to face back and down, negative to face up.
  double wrist_deg = 0.0;   ///< Positive bends towards the palm.
  double shrug_deg = 0.0;   ///< Lifts the collar bone.
  double reach_deg = 0.0;   ///< Brings the collar bone forward.
};
void place_arm(Pose& pose, Side side, const ArmPlan& plan);

/// Where a hand goes, in model space.
struct ReachPlan {
  Vec3 wrist_m;
  Vec3 elbow_to;      ///< The side to which the elbow gives way.
  Vec3 fingers_to;    ///< Direction of the straight fingers.
  Vec3 back_of_hand;  ///< Direction that the back of the hand faces.
  double shrug_deg = 0.0;
  double reach_deg = 0.0;
};
/// Turns the arm so that the hand lies as planned, or as near as the arm reaches.
void place_hand(Pose& pose, Side side, const ReachPlan& plan);

/// Curls the fingers by this many degrees at each joint. The thumb has a value of its own.
void curl_fingers(Pose& pose, Side side, double fingers_deg, double thumb_deg);
void make_fist(Pose& pose, Side side);
/// Brings the spread fingers of the bind pose together. At 1 they are parallel.
void close_fingers(Pose& pose, Side side, double amount);

}  // namespace nook::mannequin
