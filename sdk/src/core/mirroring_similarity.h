// Similarities that may include a mirroring: scaled rotations of a shape or of its mirror image.
#pragma once

#include <array>
#include <cmath>

#include "sdk/src/core/affine.h"

namespace nook {

// Returns true if the matrix mirrors, which means that its determinant is negative by more than rounding
// errors. If a float matrix flattens space, rounding makes the determinant positive or negative, with a
// magnitude of about 1e-7 relative to the matrix.
inline bool mirrors(const Affine& a) {
  double square = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) square += a.m[4 * i + j] * a.m[4 * i + j];
  return determinant(a) < -1e-6 * square * std::sqrt(square);
}

// Like nearest_similarity, but if the matrix mirrors, the result mirrors, too.
inline Similarity nearest_mirroring_similarity(const Affine& a, const std::array<double, 3>& fixed) {
  if (!mirrors(a)) return nearest_similarity(a, fixed);
  // Solves the mirrored problem: x is negated before and after the matrix.
  const auto mirrored = [](Affine m) {
    for (int i = 0; i < 3; ++i) m.m[4 * i] = -m.m[4 * i];
    return m;
  };
  Similarity result = nearest_similarity(mirrored(a), {-fixed[0], fixed[1], fixed[2]});
  result.matrix = mirrored(result.matrix);
  return result;
}

}  // namespace nook
