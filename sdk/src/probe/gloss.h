// Amplitudes of lobes for glossy reflection. If amplitudes preserve bands 0 to 2 of the light, the radiance
// can become negative between strong lights (ringing). Irradiance averages over the hemisphere and does not
// show this, but a glossy surface would show a black patch. So glossy reflection has its own amplitudes,
// which are never negative. The axes and sharpnesses of the lobes are the same.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::probe {

// Each amplitude is at least this fraction of the light around its lobe, blurred by all lobes together.
// Without this limit, non-negative least squares would set lobes beside a lamp to 0, and the black patches
// would return.
inline constexpr double least_gloss = 0.6;

// Returns the size of the scratch memory for n functions, in doubles.
constexpr std::size_t gloss_scratch_size(std::size_t n) {
  return n * n + 5 * n;
}

// Finds the amplitudes that minimise the integral of (R - f)^2, where R is the fit, f is one channel of the
// light, and each amplitude is at least `least_gloss` times the blurred light. `gram` contains the integrals
// of B_i B_k, n x n. `moment` contains the integrals of B_i f. Element i of `moment` and `amplitude` is
// stored at i * stride. The functions must be non-negative, as lobes are.
void fit_gloss(const double* gram, const double* moment, std::uint32_t n, std::size_t stride,
               double* amplitude, double* scratch);

}  // namespace nook::probe
