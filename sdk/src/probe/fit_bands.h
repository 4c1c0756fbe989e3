// Constrains a fit of lobes so that its spherical harmonics of bands 0 to 2 match the light's. These bands
// contain 99.2 % of the energy of the clamped cosine, and band 0 contains the total light. A plain
// least-squares fit of lobes does not preserve them, because it weights all bands of the radiance equally.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/probe/basis.h"

namespace nook::probe {

inline constexpr std::uint32_t band_functions = 9;  // harmonics of bands 0 to 2
inline constexpr std::uint32_t band_stride = 16;    // band_functions padded to whole SIMD vectors

// Weights of the constraint on the light's bands; see meet_bands.
inline constexpr double exact_bands = 1e6;  // the bands match to 1e-5 of the light or better
// The weight for fits whose coefficients must not be negative, and for fits on a hemisphere, where the
// horizon cuts off lobes. In these cases, an exact match does not exist or makes the fit bad. A larger weight
// would hardly improve irradiance, and would make radiance worse.
inline constexpr double soft_bands = 100;

// The basis functions and the light, projected onto the harmonics. The unit is steradians times the unit of
// the coefficients.
struct LightBands {
  std::array<double, band_functions * max_functions> function;  // 9 rows of basis.count, one column for each
                                                                // function
  std::array<double, band_functions * 3> light;                 // 9 rows of RGB
};

// Computes LightBands::function exactly, over the whole sphere. Only for Gaussians.
void project_functions(const Basis& basis, double* function);

// Let C be LightBands::function, s be LightBands::light, and G be the Gram matrix. meet_bands replaces the
// coefficients b by the b' that minimises
//   (b' - b)^T G (b' - b) + weight |C b' - s|^2,
// where a difference in band l is weighted by the squared factor of the clamped cosine for this band, which
// is its weight in irradiance. Band 0 has a thousand times more weight, so that the total light stays exact.
// `factor` is the Cholesky factor of G. `b` is stored function by function as RGB.
void meet_bands(const LightBands& bands, const double* factor, std::uint32_t count, double weight, double* b);

// Adds the second term of this objective, as a quadratic form, to the Gram matrix and to one channel of the
// moments. Use this for solvers that have additional constraints.
void add_bands(const LightBands& bands, std::uint32_t count, double weight, double* gram);
void add_bands(const LightBands& bands, std::uint32_t count, double weight, std::size_t channel,
               double* moments);

}  // namespace nook::probe
