// Amplitudes of lobes for glossy reflection. Amplitudes that keep bands 0 to 2 of the light ring: between
// strong lights their radiance falls below 0, which a glossy surface shows as a black patch. Irradiance
// averages over the hemisphere and does not show it. So gloss has amplitudes of its own, with the same axes
// and sharpnesses, that are never negative.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::probe {

// No amplitude is below this share of the light that its lobe sees, blurred by all lobes together. Without
// the bound, non-negative least squares sets lobes beside a lamp to 0, and these are dark again.
inline constexpr double least_gloss = 0.6;

// Doubles of scratch memory for n functions.
constexpr std::size_t gloss_scratch_size(std::size_t n) {
  return n * n + 5 * n;
}

// Finds the amplitudes that minimise the integral of (R - f)^2, where each is at least `least_gloss` of the
// blurred light. gram has the integrals of B_i B_k, n x n. moment has the integrals of B_i f, for one channel
// of the light f. Element i of moment and amplitude lies at i * stride. Functions must be non-negative, as
// lobes are.
void fit_gloss(const double* gram, const double* moment, std::uint32_t n, std::size_t stride,
               double* amplitude, double* scratch);

}  // namespace nook::probe
