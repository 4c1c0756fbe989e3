// Equations (24) and (25), summed as they are written: what every faster way must agree with.
#pragma once

#include <cmath>
#include <span>

#include "sdk/src/material/material.h"

namespace nook::material::test {

// S_c[a, b](x, y).
inline double spatial_mode(const ClusteredTensor& t, std::uint32_t c, std::uint32_t a, std::uint32_t b,
                           std::uint32_t x, std::uint32_t y) {
  const TensorShape& s = t.shape;
  const float* const z =
      &t.cores[c * core_size(s) + (std::size_t(a) * s.rank_view + b) * s.rank_x * s.rank_y];
  double sum = 0;
  for (std::uint32_t p = 0; p < s.rank_x; ++p)
    for (std::uint32_t q = 0; q < s.rank_y; ++q) {
      const double along_x =
          t.x_bases.empty() ? double(p == x) : t.x_bases[(std::size_t(c) * s.width + x) * s.rank_x + p];
      const double along_y =
          t.y_bases.empty() ? double(q == y) : t.y_bases[(std::size_t(c) * s.height + y) * s.rank_y + q];
      sum += z[p * s.rank_y + q] * along_x * along_y;
    }
  return sum;
}

// One row of the view mode at a texel, with the light mode's numbers of one light and channel (R_l of them).
inline double value(const ClusteredTensor& t, const ViewRows& rows, std::size_t row,
                    std::span<const float> light, std::uint32_t x, std::uint32_t y) {
  const TensorShape& s = t.shape;
  double sum = 0;
  for (std::uint32_t k = 0; k < s.mixture; ++k)
    for (std::uint32_t a = 0; a < s.rank_light; ++a)
      for (std::uint32_t b = 0; b < s.rank_view; ++b)
        sum += double(light[a]) * rows.coefficients[(row * s.mixture + k) * s.rank_view + b] *
               spatial_mode(t, rows.membership[row * s.mixture + k], a, b, x, y);
  return sum;
}

}  // namespace nook::material::test
