// Computes bent normals from occluded directions. The occluded direction of a point is the mean direction
// over its cosine-weighted hemisphere, where an open direction contributes the zero vector. If all directions
// are open, the occluded direction is 0. If no direction is open, it is 2/3 of the normal. The bent normal is
// the vector (2/3 of the normal - occluded direction), normalised.
#pragma once

#include <cmath>
#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook {

// The occluded direction of a vertex depends linearly on its AO. This struct holds the occluded directions at
// AO 0 and at AO 1. Skinning rotates them like the normal.
struct OccludedEnds {
  Vec3 dark;  // at AO 0
  Vec3 open;  // at AO 1

  Vec3 at(float ao) const { return (1 - ao) * dark + ao * open; }
};

// The length of the cosine-weighted mean direction of a fully open hemisphere.
inline constexpr float open_hemisphere = 2.0f / 3;

// Returns the bent normal as a unit vector. If no direction is open, returns the normal. `normal` and
// `occluded` must be in the same space.
inline Vec3 bent_normal(Vec3 normal, Vec3 occluded) {
  const Vec3 left = open_hemisphere * normal - occluded;
  const float size = length(left);
  return size > 1e-6f ? left * (1 / size) : normal;
}

// Encodes a coordinate from -1 to 1 as a signed byte, like a normalised GL_BYTE: 1 becomes 127.
inline std::int8_t encode_coordinate(float coordinate) {
  return static_cast<std::int8_t>(std::lround(std::fmin(std::fmax(coordinate, -1.0f), 1.0f) * 127));
}
inline float decode_coordinate(std::int8_t code) {
  return std::fmax(static_cast<float>(code) / 127, -1.0f);
}

}  // namespace nook
