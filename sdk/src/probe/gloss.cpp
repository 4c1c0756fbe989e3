#include "sdk/src/probe/gloss.h"

#include <algorithm>

#include "sdk/src/probe/dense.h"

namespace nook::probe {

void fit_gloss(const double* gram, const double* moment, std::uint32_t n, std::size_t stride,
               double* amplitude, double* scratch) {
  double* const least = scratch;
  double* const rest_moment = least + n;
  double* const above = rest_moment + n;
  double* const room = above + n;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0;
    for (std::size_t k = 0; k < n; ++k) row += gram[i * n + k];
    // With few samples, noise may make a moment negative.
    least[i] = row > 0 ? std::max(least_gloss * moment[i * stride] / row, 0.0) : 0.0;
  }
  // Subtracts the lower limits. The remaining amplitudes then only have to be non-negative.
  for (std::size_t i = 0; i < n; ++i) {
    rest_moment[i] = moment[i * stride];
    for (std::size_t k = 0; k < n; ++k) rest_moment[i] -= gram[i * n + k] * least[k];
  }
  non_negative_solve(gram, rest_moment, n, above, room);
  for (std::size_t i = 0; i < n; ++i) amplitude[i * stride] = least[i] + above[i];
}

}  // namespace nook::probe
