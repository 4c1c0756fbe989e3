#include "sdk/src/core/affine.h"

#include <algorithm>
#include <cmath>

namespace nook {

Affine operator*(const Affine& a, const Affine& b) {
  Affine r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      r.m[4 * i + j] = a.m[4 * i] * b.m[j] + a.m[4 * i + 1] * b.m[4 + j] + a.m[4 * i + 2] * b.m[8 + j] +
                       (j == 3 ? a.m[4 * i + 3] : 0);
  return r;
}

std::array<double, 3> transform(const Affine& a, double x, double y, double z) {
  const auto& m = a.m;
  return {m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
          m[8] * x + m[9] * y + m[10] * z + m[11]};
}

Vec3 transform(const Affine& a, Vec3 p) {
  const auto q = transform(a, p.x, p.y, p.z);
  return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])};
}

double determinant(const Affine& a) {
  const auto& m = a.m;
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
         m[2] * (m[4] * m[9] - m[5] * m[8]);
}

bool is_finite(const Affine& a) {
  return std::all_of(a.m.begin(), a.m.end(), [](double v) { return std::isfinite(v); });
}

Affine inverse(const Affine& a) {
  const auto& m = a.m;
  const double s = 1 / determinant(a);
  Affine r;
  r.m = {
      (m[5] * m[10] - m[6] * m[9]) * s, (m[2] * m[9] - m[1] * m[10]) * s, (m[1] * m[6] - m[2] * m[5]) * s, 0,
      (m[6] * m[8] - m[4] * m[10]) * s, (m[0] * m[10] - m[2] * m[8]) * s, (m[2] * m[4] - m[0] * m[6]) * s, 0,
      (m[4] * m[9] - m[5] * m[8]) * s,  (m[1] * m[8] - m[0] * m[9]) * s,  (m[0] * m[5] - m[1] * m[4]) * s, 0};
  for (int i = 0; i < 3; ++i)
    r.m[4 * i + 3] = -(r.m[4 * i] * m[3] + r.m[4 * i + 1] * m[7] + r.m[4 * i + 2] * m[11]);
  return r;
}

Affine from_columns(const double* columns_4x4) {
  Affine r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) r.m[4 * i + j] = columns_4x4[4 * j + i];
  return r;
}

Affine to_affine(const Trs& trs) {
  const auto [x, y, z, w] = trs.rotation;
  const auto& s = trs.scale;
  const auto& t = trs.translation;
  Affine r;
  r.m = {(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1],
         2 * (x * z + y * w) * s[2],       t[0],
         2 * (x * y + z * w) * s[0],       (1 - 2 * (x * x + z * z)) * s[1],
         2 * (y * z - x * w) * s[2],       t[1],
         2 * (x * z - y * w) * s[0],       2 * (y * z + x * w) * s[1],
         (1 - 2 * (x * x + y * y)) * s[2], t[2]};
  return r;
}

namespace {

using V3 = std::array<double, 3>;

V3 column(const Affine& a, int j) {
  return {a.m[j], a.m[4 + j], a.m[8 + j]};
}
double dot(const V3& a, const V3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
V3 cross(const V3& a, const V3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
V3 scaled(const V3& a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}

V3 any_perpendicular(const V3& a) {
  const V3 axis = std::abs(a[0]) < 0.6 ? V3{1, 0, 0} : V3{0, 1, 0};
  const V3 p = cross(a, axis);
  return scaled(p, 1 / std::sqrt(dot(p, p)));
}

// Returns the columns of a rotation, computed from the first two columns of `a`. If a column becomes 0, it is
// replaced by another direction.
std::array<V3, 3> gram_schmidt(const std::array<V3, 3>& a) {
  V3 x = a[0];
  const double nx = std::sqrt(dot(x, x));
  x = nx > 1e-12 ? scaled(x, 1 / nx) : V3{1, 0, 0};
  const double along = dot(x, a[1]);
  V3 y = {a[1][0] - along * x[0], a[1][1] - along * x[1], a[1][2] - along * x[2]};
  const double ny = std::sqrt(dot(y, y));
  y = ny > 1e-12 ? scaled(y, 1 / ny) : any_perpendicular(x);
  return {x, y, cross(x, y)};
}

V3 rotate(const V3& axis, double angle, const V3& v) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const V3 k = cross(axis, v);
  const double along = dot(axis, v) * (1 - c);
  return {v[0] * c + k[0] * s + axis[0] * along, v[1] * c + k[1] * s + axis[1] * along,
          v[2] * c + k[2] * s + axis[2] * along};
}

// Uses equation 7 of Mueller, Bender, Chentanez, Macklin 2016, "A Robust Method to Extract the Rotational
// Part of Deformations". The result is a rotation even for mirroring matrices and for matrices that flatten
// space. For these, the polar factor is not a rotation.
std::array<V3, 3> nearest_rotation(const std::array<V3, 3>& a) {
  std::array<V3, 3> r = gram_schmidt(a);
  for (int step = 0; step < 100; ++step) {
    V3 torque{};
    double stiffness = 0;
    for (int i = 0; i < 3; ++i) {
      const V3 t = cross(r[i], a[i]);
      for (int k = 0; k < 3; ++k) torque[k] += t[k];
      stiffness += dot(r[i], a[i]);
    }
    const double size = std::sqrt(dot(torque, torque));
    const double angle = size / (std::abs(stiffness) + 1e-12);
    if (angle < 1e-10) break;
    for (V3& column : r) column = rotate(scaled(torque, 1 / size), angle, column);
  }
  return gram_schmidt(r);
}

}  // namespace

Similarity nearest_similarity(const Affine& a, const std::array<double, 3>& fixed) {
  std::array<V3, 3> columns = {column(a, 0), column(a, 1), column(a, 2)};
  const double norm =
      std::sqrt(dot(columns[0], columns[0]) + dot(columns[1], columns[1]) + dot(columns[2], columns[2]));
  if (norm > 0)
    for (V3& c : columns) c = scaled(c, 1 / norm);
  const std::array<V3, 3> r = nearest_rotation(columns);

  // For a given R, |A - s R|^2 is smallest at s = <A, R> / <R, R>. A bone with scale 0 gets a tiny positive
  // scale, because a pose matrix must stay invertible.
  const double s = (dot(columns[0], r[0]) + dot(columns[1], r[1]) + dot(columns[2], r[2])) / 3 * norm;
  Similarity result;
  result.scale = std::max(s, 1e-6);
  if (std::abs(result.scale - 1) < 1e-5) result.scale = 1;
  double difference = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const double value = r[j][i] * result.scale;
      difference += (a.m[4 * i + j] - value) * (a.m[4 * i + j] - value);
      result.matrix.m[4 * i + j] = value;
    }
  result.deviation = std::sqrt(difference / 3) / result.scale;
  const V3 wanted = transform(a, fixed[0], fixed[1], fixed[2]);
  const V3 got = transform(result.matrix, fixed[0], fixed[1], fixed[2]);
  for (int i = 0; i < 3; ++i) result.matrix.m[4 * i + 3] = wanted[i] - got[i];
  return result;
}

Mat3x4 to_float(const Affine& a) {
  Mat3x4 r;
  for (int i = 0; i < 12; ++i) r.m[i] = static_cast<float>(a.m[i]);
  return r;
}

Affine to_double(const Mat3x4& a) {
  Affine r;
  std::copy_n(a.m, 12, r.m.begin());
  return r;
}

}  // namespace nook
