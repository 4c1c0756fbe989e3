#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "samples/mannequin/skeleton.h"

namespace nook_samples::mannequin {

/// Left is +x. Everything that exists twice is addressed by a side.
enum class Side { kLeft, kRight };

/// A pose as turns away from the bind pose. A bone's turn is relative to its parent and written along the
/// model's axes, whatever way the bone's own axes point, so that motion can be described in terms of the
/// body.
class Pose {
 public:
  explicit Pose(const Skeleton& skeleton);

  void shift_pelvis(const Vec3& offset_m) { pelvis_shift_m_ += offset_m; }
  const Vec3& pelvis_shift_m() const { return pelvis_shift_m_; }

  /// Adds a turn about a model axis; x bends forward for positive angles, y turns to the left, z leans to the
  /// right.
  void turn(std::string_view bone, const Vec3& axis, double angle_deg);
  void set_turn(int bone, const Quat& turn) { turns_[static_cast<std::size_t>(bone)] = turn; }
  const Quat& turn_of(int bone) const { return turns_[static_cast<std::size_t>(bone)]; }

  /// Model-space rotation away from the bind pose, with all the parents' turns.
  Quat facing(int bone) const;
  Vec3 joint_m(int bone) const;
  /// Where a point that is fixed to the bone, given in the bind pose, is now.
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

}  // namespace nook_samples::mannequin
