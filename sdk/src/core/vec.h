// Small vectors and affine matrices of the runtime: plain data, row-major, without alignment requirements.
#pragma once

#include <cmath>

namespace nook {

struct Vec3 {
  float x = 0, y = 0, z = 0;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(Vec3 a, float s) {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(float s, Vec3 a) {
  return a * s;
}
constexpr Vec3& operator+=(Vec3& a, Vec3 b) {
  return a = a + b;
}
constexpr bool operator==(Vec3 a, Vec3 b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
constexpr float dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) {
  return std::sqrt(dot(a, a));
}
// Returns the vector with length 1. Returns a zero vector unchanged. The caller can then detect and replace
// it.
inline Vec3 normalised(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}

// Three rows of [rotation and scale | translation], which is the public 3x4 layout.
struct Mat3x4 {
  float m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

constexpr Vec3 transform_point(const Mat3x4& a, Vec3 p) {
  const float* m = a.m;
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

// Transforms a vector without the translation. Use it for directions. You may also use it for normals, if the
// matrix is rigid or uniformly scaled and you renormalise the result.
constexpr Vec3 transform_vector(const Mat3x4& a, Vec3 v) {
  const float* m = a.m;
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
          m[8] * v.x + m[9] * v.y + m[10] * v.z};
}

// Returns the matrix that applies b first, then a.
constexpr Mat3x4 operator*(const Mat3x4& a, const Mat3x4& b) {
  Mat3x4 r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      r.m[4 * i + j] = a.m[4 * i] * b.m[j] + a.m[4 * i + 1] * b.m[4 + j] + a.m[4 * i + 2] * b.m[8 + j] +
                       (j == 3 ? a.m[4 * i + 3] : 0);
  return r;
}

}  // namespace nook
