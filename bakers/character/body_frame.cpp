#include "bakers/character/body_frame.h"

#include "bakers/character/joint_origin.h"

namespace nook::bake {

BodyFrame body_frame(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  Vec3 sum;
  for (std::size_t b = 0; b < joints.size(); ++b) {
    if (joints[b].role == JointRole::other) continue;
    if (joints[b].side == Side::left) sum += joint_origin(mesh.bones[b]);
    if (joints[b].side == Side::right) sum += -1.0f * joint_origin(mesh.bones[b]);
  }
  BodyFrame frame;
  frame.up = {0, 1, 0};
  frame.left = normalised({sum.x, 0, sum.z});
  if (dot(frame.left, frame.left) == 0) frame.left = {1, 0, 0};
  frame.forward = cross(frame.left, frame.up);
  return frame;
}

Vec3 limb_direction(const SkinnedMesh& mesh, std::span<const Joint> joints, std::size_t bone) {
  const std::int32_t next = joints[bone].continuation;
  return next < 0 ? Vec3{}
                  : normalised(joint_origin(mesh.bones[std::size_t(next)]) - joint_origin(mesh.bones[bone]));
}

}  // namespace nook::bake
