// Tests whether the matrix of a bone is a rotation with uniform scale. All code uses this one test, so that
// float and double matrices get the same result.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace nook {

// The lengths of the axes of a matrix, and the angles between them. The axes are the columns of its 3x3 part.
template <class Real>
struct BoneAxes {
  std::array<Real, 3> squared{};  // length of each axis
  Real longest_squared = 0;
  Real shear = 0;  // the largest absolute dot product of two axes; divided by longest_squared, it is about
                   // the cosine of the angle between them

  // True if the matrix is a rotation with uniform scale, with a tolerance of 1 % of the length. The constants
  // allow about 2 %, because squared lengths are compared. Their last digits allow for rounding. A zero
  // matrix returns false.
  bool is_even() const {
    const Real shortest = std::min({squared[0], squared[1], squared[2]});
    return longest_squared > 0 && longest_squared <= shortest * Real(1.0205) &&
           shear <= longest_squared * Real(0.0101);
  }
  double length(int axis) const { return std::sqrt(double(squared[axis])); }
  double cosine() const { return longest_squared > 0 ? double(shear / longest_squared) : 0; }
};

// `matrix.m` holds three rows of four elements.
template <class Matrix>
auto axes_of(const Matrix& matrix) {
  const auto& m = matrix.m;
  const auto product = [&](int i, int j) { return m[i] * m[j] + m[4 + i] * m[4 + j] + m[8 + i] * m[8 + j]; };
  BoneAxes<decltype(product(0, 0))> axes;
  for (int i = 0; i < 3; ++i) axes.squared[std::size_t(i)] = product(i, i);
  axes.longest_squared = std::max({axes.squared[0], axes.squared[1], axes.squared[2]});
  axes.shear = std::max({std::abs(product(0, 1)), std::abs(product(1, 2)), std::abs(product(2, 0))});
  return axes;
}

}  // namespace nook
