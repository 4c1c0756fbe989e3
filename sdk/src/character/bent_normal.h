// Bent normals from occluded directions. The occluded direction of a point is the mean over its
// cosine-weighted hemisphere of the directions that are occluded, where open directions count as zero: 0
// where all is open, 2/3 of the normal where nothing is. What is left of 2/3 of the normal points to where
// the point is open.
#pragma once

#include <cmath>
#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook {

// The occluded directions of a vertex are on a line over its AO; these are its ends. They turn as the normal
// does.
struct OccludedEnds {
  Vec3 dark;  // at AO 0
  Vec3 open;  // at AO 1

  Vec3 at(float ao) const { return (1 - ao) * dark + ao * open; }
};

// The length of the mean direction of an open hemisphere under the cosine.
inline constexpr float open_hemisphere = 2.0f / 3;

// Returns a unit vector: the normal where nothing is left. Both vectors are in one space.
inline Vec3 bent_normal(Vec3 normal, Vec3 occluded) {
  const Vec3 left = open_hemisphere * normal - occluded;
  const float size = length(left);
  return size > 1e-6f ? left * (1 / size) : normal;
}

// A coordinate of -1 to 1 as a signed byte of which 127 is 1, as GL_BYTE is when it is normalised.
inline std::int8_t encode_coordinate(float coordinate) {
  return static_cast<std::int8_t>(std::lround(std::fmin(std::fmax(coordinate, -1.0f), 1.0f) * 127));
}
inline float decode_coordinate(std::int8_t code) {
  return std::fmax(static_cast<float>(code) / 127, -1.0f);
}

}  // namespace nook
