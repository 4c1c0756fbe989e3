// Lobes as spherical harmonics.
#pragma once

#include <cstdint>
#include <span>

#include "core/spherical_gaussian.h"
#include "core/vec.h"

namespace nook::probe {

// What convolution with a lobe of integral 1 does to band l <= 4 of a function: 1 for l = 0, falling with l.
double gaussian_band(double sharpness, std::uint32_t l);

// The projection onto the harmonics of bands 0 to order <= 4, (order + 1)^2 coefficients, exact.
void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients);

}  // namespace nook::probe
