// Real spherical harmonics of bands 0 to 4, orthonormal over the sphere. They are stored band by band, from m
// = -l to l, and do not include the Condon-Shortley phase (P.-P. Sloan, Stupid Spherical Harmonics Tricks,
// 2008).
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"
#include "shaders/probe/constants.h"

namespace nook::probe {

constexpr std::uint32_t harmonic_count(std::uint32_t order) {
  return (order + 1) * (order + 1);
}

// Writes (order + 1)^2 values. (x, y, z) must be a unit vector.
template <std::floating_point T>
constexpr void evaluate_harmonics(std::uint32_t order, T x, T y, T z, T* values) {
  values[0] = T(NOOK_HARMONICS_0);
  if (order < 1) return;
  values[1] = T(NOOK_HARMONICS_1) * y;
  values[2] = T(NOOK_HARMONICS_1) * z;
  values[3] = T(NOOK_HARMONICS_1) * x;
  if (order < 2) return;
  const T xx = x * x, yy = y * y, zz = z * z;
  values[4] = T(NOOK_HARMONICS_2_MIXED) * x * y;
  values[5] = T(NOOK_HARMONICS_2_MIXED) * y * z;
  values[6] = T(NOOK_HARMONICS_2_ZONAL) * (3 * zz - 1);
  values[7] = T(NOOK_HARMONICS_2_MIXED) * x * z;
  values[8] = T(NOOK_HARMONICS_2_SQUARES) * (xx - yy);
  if (order < 3) return;
  values[9] = T(0.5900435899266435) * y * (3 * xx - yy);
  values[10] = T(2.890611442640554) * x * y * z;
  values[11] = T(0.4570457994644658) * y * (5 * zz - 1);
  values[12] = T(0.3731763325901154) * z * (5 * zz - 3);
  values[13] = T(0.4570457994644658) * x * (5 * zz - 1);
  values[14] = T(1.445305721320277) * z * (xx - yy);
  values[15] = T(0.5900435899266435) * x * (xx - 3 * yy);
  if (order < 4) return;
  values[16] = T(2.5033429417967046) * x * y * (xx - yy);
  values[17] = T(1.7701307697799304) * y * z * (3 * xx - yy);
  values[18] = T(0.9461746957575601) * x * y * (7 * zz - 1);
  values[19] = T(0.6690465435572892) * y * z * (7 * zz - 3);
  values[20] = T(0.10578554691520431) * (35 * zz * zz - 30 * zz + 3);
  values[21] = T(0.6690465435572892) * x * z * (7 * zz - 3);
  values[22] = T(0.47308734787878004) * (xx - yy) * (7 * zz - 1);
  values[23] = T(1.7701307697799304) * x * z * (xx - 3 * yy);
  values[24] = T(0.6258357354491761) * (xx * (xx - 3 * yy) - yy * (3 * xx - yy));
}

// The factor of the clamped cosine for each band: irradiance is the sum over the bands of the factor times
// the band's radiance.
inline constexpr double cosine_band[5] = {3.141592653589793, 2.0943951023931953, 0.7853981633974483, 0,
                                          -0.13089969389957473};

// Light as spherical harmonics of bands 0 and 1, and the part of band 2 that is rotationally symmetric around
// the axis of band 1. This is ZH3 (T. Roughton, P.-P. Sloan, A. Silvennoinen, M. Iwanicki, P. Shirley, ZH3:
// Quadratic Zonal Harmonics, 2024).

inline constexpr std::size_t zonal_count = 5;  // coefficients: bands 0 and 1, then the zonal one

// `harmonics` holds the nine coefficients of bands 0 to 2. The zonal coefficient is the projection of band 2,
// because the projection has the smallest squared error.
std::array<Vec3, zonal_count> to_zonal(std::span<const Vec3> harmonics);

Vec3 zonal_radiance(std::span<const Vec3> zonal, Vec3 direction);
Vec3 zonal_irradiance(std::span<const Vec3> zonal, Vec3 normal);

// Projects lobes exactly onto the harmonics of bands 0 to `order`, which must be at most 4. Writes (order +
// 1)^2 coefficients.
void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients);

}  // namespace nook::probe
