// The position and size of a posed body, and the scale of its bones.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/core/vec.h"

namespace nook {

// BoneAxes::is_even allows a little shear and uneven scale. Such a matrix scales a vector by less than this
// factor times the length of its longest axis.
inline constexpr float bone_scale_margin = 1.02f;

// A sphere that contains all key points and proxy spheres of a pose, and an upper bound of the bones' scales.
struct PoseBound {
  Vec3 centre;
  float radius = 0;
  float scale = 1;
};

// `bones` must have one matrix for each bone of the model. longest_squared is the squared length of the
// longest axis of any bone.
inline PoseBound bound_of_bones(const LoadedModel& loaded, std::span<const Mat3x4> bones,
                                float longest_squared) noexcept {
  PoseBound out;
  out.scale = std::sqrt(longest_squared) * bone_scale_margin;
  out.centre = transform_point(bones[loaded.model.root_bone], loaded.model.bounding_centre);
  for (std::size_t b = 0; b < loaded.bone_bounds.size(); ++b) {
    const LoadedModel::BoneBound& bound = loaded.bone_bounds[b];
    if (bound.radius < 0) continue;
    const float reach =
        length(transform_point(bones[b], bound.centre) - out.centre) + out.scale * bound.radius;
    out.radius = std::max(out.radius, reach);
  }
  return out;
}

}  // namespace nook
