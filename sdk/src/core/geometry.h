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

// A capsule in world space that casts. It hides a light with its radii, and counts in AO with ao_scale times
// them.
struct PosedCaster {
  Capsule capsule;
  float ao_scale = 1;
};

// Metres along each axis. A float's step is 6 cm at the bound, so that neither a character nor a scene makes
// sense beyond it, and every later product of coordinates stays finite.
constexpr float max_metres = 1e6f;

// False for what is not finite.
inline bool is_place(Vec3 p) {
  return std::abs(p.x) <= max_metres && std::abs(p.y) <= max_metres && std::abs(p.z) <= max_metres;
}

// Of the matrices of a pose, rest space to world: far beyond any world, and small enough that squares of what
// they place stay finite.
constexpr float max_pose_metres = 1e9f, max_pose_scale = 1e6f;

// False for what is not finite.
inline bool is_pose_matrix(const Mat3x4& matrix) {
  for (int i = 0; i < 12; ++i)
    if (!(std::abs(matrix.m[i]) <= (i % 4 == 3 ? max_pose_metres : max_pose_scale))) return false;
  return true;
}

}  // namespace nook
