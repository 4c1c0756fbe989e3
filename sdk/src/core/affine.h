// Affine transforms in double precision. Float precision would lose too many digits in chains of nodes under
// a node with scale 0.01.
#pragma once

#include <array>

#include "sdk/src/core/vec.h"

namespace nook {

// Three rows of [linear part | translation], like Mat3x4.
struct Affine {
  std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
};

Affine operator*(const Affine& a, const Affine& b);  // applies b first
std::array<double, 3> transform(const Affine& a, double x, double y, double z);
Vec3 transform(const Affine& a, Vec3 p);
double determinant(const Affine& a);
bool is_finite(const Affine& a);

// determinant(a) must not be 0.
Affine inverse(const Affine& a);

// Converts a column-major 4x4 matrix, as in glTF. The last row must be 0 0 0 1 and is not read.
Affine from_columns(const double* columns_4x4);

// A translation, a unit quaternion (x, y, z, w) and a scale. The scale is applied first, then the rotation,
// then the translation.
struct Trs {
  std::array<double, 3> translation{0, 0, 0};
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> scale{1, 1, 1};
};
Affine to_affine(const Trs& trs);

// The nearest similarity s * R in the Frobenius norm, where R is a rotation and s > 0.
struct Similarity {
  Affine matrix;
  double scale = 1;
  double deviation = 0;  // relative deviation of the linear part, 0 for a rigid or uniformly scaled matrix
};

// Returns the similarity that is nearest to `a` and maps the point `fixed` to the same point as `a` does.
// Pass the joint's origin as `fixed`, so that the joint does not move when the shear is removed.
Similarity nearest_similarity(const Affine& a, const std::array<double, 3>& fixed);

Mat3x4 to_float(const Affine& a);
Affine to_double(const Mat3x4& a);

}  // namespace nook
