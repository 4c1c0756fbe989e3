// Light as spherical harmonics of bands 0 and 1 and the part of band 2 that is symmetric round band 1's axis:
// ZH3 (T. Roughton, P.-P. Sloan, A. Silvennoinen, M. Iwanicki, P. Shirley, ZH3: Quadratic Zonal Harmonics,
// 2024).
#pragma once

#include <array>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::probe {

inline constexpr std::size_t zonal_count = 5;  // coefficients: bands 0 and 1, then the zonal one

// harmonics: bands 0 to 2, nine coefficients. The projection of band 2, so that no other zonal coefficient
// has less square error.
std::array<Vec3, zonal_count> to_zonal(std::span<const Vec3> harmonics);

Vec3 zonal_radiance(std::span<const Vec3> zonal, Vec3 direction);
Vec3 zonal_irradiance(std::span<const Vec3> zonal, Vec3 normal);

}  // namespace nook::probe
