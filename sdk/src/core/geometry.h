// Capsules, and the maximum distance of geometry from the origin.
#pragma once

#include <cmath>

#include "sdk/src/core/vec.h"

namespace nook {

// Metres. A sphere is a capsule whose ends are equal.
struct Capsule {
  Vec3 a, b;
  float radius_a = 0, radius_b = 0;
};

// A capsule in world space that casts. Its radii hide a light; for AO, they are multiplied by ao_scale.
struct PosedCaster {
  Capsule capsule;
  float ao_scale = 1;
};

// The bound on each coordinate, in metres. A float's step there is 6 cm, so characters and scenes beyond it
// make no sense, and every product of coordinates stays finite.
constexpr float max_metres = 1e6f;

// False if a coordinate is not finite.
inline bool is_place(Vec3 p) {
  return std::abs(p.x) <= max_metres && std::abs(p.y) <= max_metres && std::abs(p.z) <= max_metres;
}

// Bounds for the matrices of a pose, from rest space to world. They are far beyond any world, yet squares of
// the moved positions stay finite.
constexpr float max_pose_metres = 1e9f, max_pose_scale = 1e6f;

// False if a number is not finite.
inline bool is_pose_matrix(const Mat3x4& matrix) {
  for (int i = 0; i < 12; ++i)
    if (!(std::abs(matrix.m[i]) <= (i % 4 == 3 ? max_pose_metres : max_pose_scale))) return false;
  return true;
}

}  // namespace nook
