// Where a joint is.
#pragma once

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// In rest space, metres.
inline Vec3 joint_origin(const Bone& bone) {
  return {bone.frame_rest.m[3], bone.frame_rest.m[7], bone.frame_rest.m[11]};
}

}  // namespace nook::bake
