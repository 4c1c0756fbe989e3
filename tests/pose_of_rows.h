// The pose that tests give most often: one rest-to-world matrix for each bone, three rows of four.
#pragma once

#include <nook/nook_character.h>

namespace nook::test {

// rows_3x4 has 12 floats for each bone and must live until the pose is set.
inline nook_pose_desc pose_of_rows(const float* rows_3x4, std::size_t bone_count) {
  nook_pose_desc desc;
  nook_pose_desc_init(&desc);
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  desc.transforms = rows_3x4;
  desc.transform_count = static_cast<std::uint32_t>(bone_count);
  return desc;
}

inline nook_result set_rows(nook_scene scene, nook_instance_id instance, const float* rows_3x4,
                            std::size_t bone_count) {
  const nook_pose_desc desc = pose_of_rows(rows_3x4, bone_count);
  return nook_scene_set_pose(scene, instance, &desc);
}

}  // namespace nook::test
