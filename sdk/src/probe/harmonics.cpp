#include "sdk/src/probe/harmonics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/probe/constants.h"

namespace nook::probe {
namespace {

constexpr float pi = 3.14159265f;

float luminance(Vec3 rgb) {
  return float(NOOK_LUMINANCE_RED) * rgb.x + float(NOOK_LUMINANCE_GREEN) * rgb.y +
         float(NOOK_LUMINANCE_BLUE) * rgb.z;
}

// Returns the main direction of the light, which is the direction of the luminance of band 1. The order of
// band 1's harmonics is y, z, x. Returns +z if band 1 is 0.
Vec3 axis_of(std::span<const Vec3> c) {
  const Vec3 axis{luminance(c[3]), luminance(c[1]), luminance(c[2])};
  const float size = length(axis);
  return size > 0 ? axis * (1 / size) : Vec3{0, 0, 1};
}

// `factor` has one value for each band.
Vec3 sum(std::span<const Vec3> c, Vec3 direction, const float factor[3]) {
  std::array<float, 4> linear;
  evaluate_harmonics(1, direction.x, direction.y, direction.z, linear.data());
  Vec3 value = c[0] * (factor[0] * linear[0]);
  for (std::size_t i = 1; i < 4; ++i) value += c[i] * (factor[1] * linear[i]);
  const float cosine = dot(axis_of(c), direction);
  return value + c[4] * (factor[2] * float(NOOK_HARMONICS_2_ZONAL) * (3 * cosine * cosine - 1));
}

}  // namespace

std::array<Vec3, zonal_count> to_zonal(std::span<const Vec3> harmonics) {
  std::array<Vec3, zonal_count> zonal;
  std::copy_n(harmonics.begin(), 4, zonal.begin());
  const Vec3 axis = axis_of(harmonics);
  std::array<float, harmonic_count(2)> values;
  evaluate_harmonics(2, axis.x, axis.y, axis.z, values.data());
  // By the addition theorem, the zonal harmonic around the axis has the coefficients sqrt(4 pi / 5)
  // Y_2m(axis).
  const float scale = std::sqrt(4 * pi / 5);
  for (std::size_t i = 4; i < harmonic_count(2); ++i) zonal[4] += harmonics[i] * (scale * values[i]);
  return zonal;
}

Vec3 zonal_radiance(std::span<const Vec3> zonal, Vec3 direction) {
  constexpr float factor[3] = {1, 1, 1};
  return sum(zonal, direction, factor);
}

Vec3 zonal_irradiance(std::span<const Vec3> zonal, Vec3 normal) {
  constexpr float factor[3] = {float(cosine_band[0]), float(cosine_band[1]), float(cosine_band[2])};
  return sum(zonal, normal, factor);
}

void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients) {
  std::fill(coefficients.begin(), coefficients.end(), Vec3{});
  std::array<double, harmonic_count(4)> values;
  for (const SphericalGaussian& g : lobes) {
    evaluate_harmonics(order, double(g.axis.x), double(g.axis.y), double(g.axis.z), values.data());
    const double mass = gaussian_integral(double(g.sharpness));
    const std::array<double, 5> bands = gaussian_bands(double(g.sharpness));
    for (std::uint32_t l = 0, i = 0; l <= order; ++l)
      for (; i < harmonic_count(l); ++i) coefficients[i] += g.amplitude * float(mass * bands[l] * values[i]);
  }
}

}  // namespace nook::probe
