// Rigid turns as 3x4 matrices.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/core/vec.h"

namespace nook::bake {

// Returns the rotation about `axis_angle` by Rodrigues' formula. The vector's length is the angle in radians.
inline Mat3x4 rotation(Vec3 axis_angle) {
  const float angle = length(axis_angle);
  Mat3x4 r;
  if (angle == 0) return r;
  const Vec3 a = axis_angle * (1 / angle);
  const float c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  const float m[12] = {t * a.x * a.x + c,       t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y, 0,
                       t * a.x * a.y + s * a.z, t * a.y * a.y + c,       t * a.y * a.z - s * a.x, 0,
                       t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c,       0};
  std::copy_n(m, 12, r.m);
  return r;
}

// Returns the shortest turn that takes one unit vector to another, as axis times angle, in radians.
inline Vec3 shortest_arc(Vec3 from, Vec3 to) {
  const Vec3 axis = cross(from, to);
  const float s = length(axis), c = dot(from, to);
  if (s < 1e-6f) {
    if (c > 0) return {};
    const Vec3 any = std::fabs(from.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return std::numbers::pi_v<float> * normalised(cross(from, any));
  }
  return std::atan2(s, c) / s * axis;
}

// Returns a turn about an axis through a point.
inline Mat3x4 rotation_about(Vec3 point, Vec3 axis_angle) {
  Mat3x4 r = rotation(axis_angle);
  const Vec3 t = point - transform_vector(r, point);
  r.m[3] = t.x;
  r.m[7] = t.y;
  r.m[11] = t.z;
  return r;
}

inline Mat3x4 inverse_rigid(const Mat3x4& a) {
  Mat3x4 r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r.m[4 * i + j] = a.m[4 * j + i];
  const Vec3 t = transform_vector(r, {a.m[3], a.m[7], a.m[11]});
  r.m[3] = -t.x;
  r.m[7] = -t.y;
  r.m[11] = -t.z;
  return r;
}

}  // namespace nook::bake
