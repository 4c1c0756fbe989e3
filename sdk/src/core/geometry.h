// Defines capsules, and limits for positions and poses.
#pragma once

#include <cmath>

#include "sdk/src/core/vec.h"

namespace nook {

// A capsule, in metres. If both ends are equal, it is a sphere.
struct Capsule {
  Vec3 a, b;
  float radius_a = 0, radius_b = 0;
};

// A capsule in world space that casts a shadow and AO. For shadows, its radii are used unchanged; for AO,
// they are multiplied by ao_scale.
struct PosedCaster {
  Capsule capsule;
  float ao_scale = 1;
};

// Limit for the magnitude of each coordinate, in metres. At this distance, neighbouring floats differ by 6
// cm, so larger coordinates are not useful. Within the limit, all products of coordinates are finite.
constexpr float max_metres = 1e6f;

// True if no coordinate exceeds max_metres in magnitude. False if a coordinate is not finite.
inline bool is_place(Vec3 p) {
  return std::abs(p.x) <= max_metres && std::abs(p.y) <= max_metres && std::abs(p.z) <= max_metres;
}

// Limits for the matrices of a pose, which map rest space to world space. No world needs larger values.
// Within the limits, the squares of transformed positions are finite.
constexpr float max_pose_metres = 1e9f, max_pose_scale = 1e6f;

// True if the matrix is within these limits. False if an element is not finite.
inline bool is_pose_matrix(const Mat3x4& matrix) {
  for (int i = 0; i < 12; ++i)
    if (!(std::abs(matrix.m[i]) <= (i % 4 == 3 ? max_pose_metres : max_pose_scale))) return false;
  return true;
}

}  // namespace nook
