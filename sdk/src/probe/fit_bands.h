// Makes lobes agree with a light in its spherical harmonics of bands 0 to 2. These hold 99.2 % of the clamped
// cosine's energy and, in band 0, the light's total. A plain least-squares fit of lobes misses them, because
// it weighs the radiance of all bands alike.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/probe/basis.h"

namespace nook::probe {

inline constexpr std::uint32_t band_functions = 9;  // harmonics of bands 0 to 2
inline constexpr std::uint32_t band_stride = 16;    // the same in whole vectors

// The weight of the constraint on the light's bands; see meet_bands.
inline constexpr double exact_bands = 1e6;  // equal, to 1e-5 of the light or better
// If coefficients may not be negative, or lobes end at a horizon, equality has no solution or a bad one. A
// larger weight would hardly improve irradiance, and would make radiance worse.
inline constexpr double soft_bands = 100;

// Projections onto the harmonics, in steradians times the unit of the coefficients.
struct LightBands {
  std::array<double, band_functions * max_functions> function;  // 9 rows of basis.count, one column for each
                                                                // function
  std::array<double, band_functions * 3> light;                 // 9 rows of RGB
};

// Fills the functions' rows over the whole sphere, exactly. Gaussians only.
void project_functions(const Basis& basis, double* function);

// Let C be the functions' rows, s the light and G the Gram matrix. Replaces the coefficients b by the b' that
// minimises
//   (b' - b)^T G (b' - b) + weight |C b' - s|^2,
// where the difference of band l is weighted by the square of the clamped cosine's factor of that band, which
// is its share of irradiance. Band 0 counts a thousand times more, so that the total light stays exact.
// factor: the Cholesky factor of G. b: function by function, RGB.
void meet_bands(const LightBands& bands, const double* factor, std::uint32_t count, double weight, double* b);

// Adds the same objective as a quadratic form to the Gram matrix and to one channel of the moments, for
// solvers with their own constraints.
void add_bands(const LightBands& bands, std::uint32_t count, double weight, double* gram);
void add_bands(const LightBands& bands, std::uint32_t count, double weight, std::size_t channel,
               double* moments);

}  // namespace nook::probe
