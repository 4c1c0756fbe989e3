// Lobes as spherical harmonics.
#pragma once

#include <cstdint>
#include <span>

#include "core/spherical_gaussian.h"

namespace nook::probe {

// Real harmonics of bands 0 to order <= 4 at a unit direction, (order + 1)^2 of them, orthonormal over the
// sphere, band by band from m = -l to l, no Condon-Shortley phase.
void evaluate_harmonics(std::uint32_t order, const double direction[3], double* values);

// The l-th zonal moment of a lobe of integral 1: what a rotationally symmetric filter does to band l.
// l <= 4.
double gaussian_band(double sharpness, std::uint32_t l);

// (order + 1)^2 coefficients, exact.
void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients);

}  // namespace nook::probe
