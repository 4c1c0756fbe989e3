#include "samples/mannequin/pose.h"

namespace nook_samples::mannequin {

Pose::Pose(const Skeleton& skeleton)
    : skeleton_(&skeleton), turns_(skeleton.size(), Quat(1.0, 0.0, 0.0, 0.0)) {}

void Pose::turn(std::string_view bone, const Vec3& axis, double angle_deg) {
  Quat& q = turns_[static_cast<std::size_t>(skeleton_->find(bone))];
  q = glm::normalize(glm::angleAxis(glm::radians(angle_deg), glm::normalize(axis)) * q);
}

Quat Pose::facing(int bone) const {
  const auto i = static_cast<std::size_t>(bone);
  const int parent = skeleton_->bones()[i].parent;
  return parent < 0 ? turns_[i] : facing(parent) * turns_[i];
}

Vec3 Pose::joint_m(int bone) const {
  const Bone& b = skeleton_->bones()[static_cast<std::size_t>(bone)];
  if (b.parent < 0) {
    return b.position_m;
  }
  const Vec3 shift = b.name == "pelvis" ? pelvis_shift_m_ : Vec3(0.0);
  return carried_m(b.parent, b.position_m + shift);
}

Vec3 Pose::carried_m(int bone, const Vec3& bind_point_m) const {
  const Vec3 offset = bind_point_m - skeleton_->bones()[static_cast<std::size_t>(bone)].position_m;
  return joint_m(bone) + facing(bone) * offset;
}

Quat Pose::local_rotation(int bone) const {
  const auto i = static_cast<std::size_t>(bone);
  const int parent = skeleton_->bones()[i].parent;
  const Quat parent_axes = parent < 0 ? Quat(1.0, 0.0, 0.0, 0.0)
                                      : skeleton_->bones()[static_cast<std::size_t>(parent)].orientation;
  return glm::normalize(glm::conjugate(parent_axes) * turns_[i] * skeleton_->bones()[i].orientation);
}

std::string sided(std::string_view bone, Side side) {
  return std::string(bone) + (side == Side::kLeft ? "_l" : "_r");
}

double sign_of(Side side) {
  return side == Side::kLeft ? 1.0 : -1.0;
}

}  // namespace nook_samples::mannequin
