// Constrains a fit of lobes so that its spherical harmonics of bands 0 to 2 match the light's. These bands
// contain 99.2 % of the energy of the clamped cosine, and band 0 contains the total light. A plain
// least-squares fit of lobes does not preserve them, because it gives all bands of the radiance the same
// weight.
#pragma once

#include <array>
#include <cstdint>

#include "sdk/src/probe/basis.h"

namespace nook::probe {

inline constexpr std::uint32_t band_functions = 9;  // harmonics of bands 0 to 2
inline constexpr std::uint32_t band_stride = 16;    // band_functions padded to whole SIMD vectors

// Weights of the constraint on the light's bands; see meet_bands.
inline constexpr double exact_bands = 1e6;  // the bands match to 1e-5 of the light or better
// The weight for coefficients that must not be negative, and for lobes that end at a horizon. In these cases,
// an exact match does not exist or makes the fit bad. A larger weight would hardly improve irradiance, and
// would make radiance worse.
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
// where differences in band l are weighted by the square of the clamped cosine's factor for that band, which
// is the band's contribution to irradiance. Band 0 has a thousand times more weight, so that the total light
// stays exact. `factor` is the Cholesky factor of G. `b` is stored function by function as RGB.
void meet_bands(const LightBands& bands, const double* factor, std::uint32_t count, double weight, double* b);

// Adds the second term of this objective, as a quadratic form, to the Gram matrix and to one channel of the
// moments. Use this for solvers that have constraints of their own.
void add_bands(const LightBands& bands, std::uint32_t count, double weight, double* gram);
void add_bands(const LightBands& bands, std::uint32_t count, double weight, std::size_t channel,
               double* moments);

}  // namespace nook::probe
