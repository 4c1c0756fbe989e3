// Lobes that agree with a light in its spherical harmonics of bands 0 to 2, which hold 99.2 % of the clamped
// cosine's energy and, in band 0, the light's total. Lobes that are fitted by least squares alone miss them,
// because radiance of all bands has the same weight there.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/probe/basis.h"

namespace nook::probe {

inline constexpr std::uint32_t band_functions = 9;  // harmonics of bands 0 to 2
inline constexpr std::uint32_t band_stride = 16;    // the same in whole vectors

// The weight of the constraint on the light's bands; see meet_bands.
inline constexpr double exact_bands = 1e6;  // equal, to 1e-5 of the light or better
// If coefficients may not be negative, or lobes end at a horizon, equality has no solution or a bad one. With
// a larger weight irradiance improves little, and radiance gets worse.
inline constexpr double soft_bands = 100;

// Projections on the harmonics, in steradians times their coefficients' unit.
struct LightBands {
  std::array<double, band_functions * max_functions> function;  // 9 rows of basis.count: of each function
  std::array<double, band_functions * 3> light;                 // 9 rows of RGB
};

// The functions' rows over the whole sphere, exact. Gaussians only.
void project_functions(const Basis& basis, double* function);

// With C the functions' rows, s the light and G the Gram matrix, the coefficients b become those that
// minimise
//   (b' - b)^T G (b' - b) + weight |C b' - s|^2,
// where the difference of band l counts by the square of the clamped cosine's factor of that band, which is
// its share of irradiance, and band 0 a thousand times more, so that the total light stays exact. factor:
// Cholesky's of G. b: function by function, RGB.
void meet_bands(const LightBands& bands, const double* factor, std::uint32_t count, double weight, double* b);

// The same objective as a quadratic form, for solvers with constraints of their own: adds it to the Gram
// matrix, and to one channel of the moments.
void add_bands(const LightBands& bands, std::uint32_t count, double weight, double* gram);
void add_bands(const LightBands& bands, std::uint32_t count, double weight, std::size_t channel,
               double* moments);

}  // namespace nook::probe
