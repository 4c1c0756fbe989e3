#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "samples/mannequin/skeleton.h"

namespace nook_samples::mannequin {

/// A side of the body, of which left is +x. It addresses everything that exists twice.
enum class Side { kLeft, kRight };

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

}  // namespace nook_samples::mannequin
