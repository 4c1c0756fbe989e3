// Lobes as spherical harmonics.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"

namespace nook::probe {

// The projection onto the harmonics of bands 0 to order <= 4, (order + 1)^2 coefficients, exact.
void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients);

}  // namespace nook::probe
