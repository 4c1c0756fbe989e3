// Spherical Gaussians, called lobes, and their closed forms:
//   G(s) = amplitude exp(sharpness (dot(axis, s) - 1)).
// A lobe of sharpness 0 is constant over the sphere. The functions are accurate from sharpness 0 up to lobes
// that are narrower than float directions can resolve. The reason is that large exponents are subtracted
// before the exponential is computed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <numbers>

#include "sdk/src/core/vec.h"
#include "shaders/core/constants.h"

namespace nook {

struct SphericalGaussian {
  Vec3 axis{0, 0, 1};   // unit
  float sharpness = 0;  // >= 0
  Vec3 amplitude;       // linear RGB
};

// Returns 1 - dot(a, b) of unit vectors. There is no cancellation for nearly equal vectors.
constexpr float one_minus_cosine(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return 0.5f * dot(d, d);
}

// Returns G(s) for amplitude 1 and a unit vector s.
inline float gaussian_value(Vec3 axis, float sharpness, Vec3 s) {
  return std::exp(-sharpness * one_minus_cosine(axis, s));
}

// Returns the integral of G over the sphere for amplitude 1: 2 pi (1 - e^(-2 sharpness)) / sharpness.
template <std::floating_point T>
T gaussian_integral(T sharpness) {
  constexpr T pi = std::numbers::pi_v<T>;
  if (sharpness < T(1e-15)) return 4 * pi;
  return -2 * pi * std::expm1(-2 * sharpness) / sharpness;
}

// Returns the integral of G^2 over the sphere for amplitude 1. G^2 is a lobe of twice the sharpness: pi (1 -
// e^(-4 sharpness)) / sharpness.
template <std::floating_point T>
T gaussian_square_integral(T sharpness) {
  return gaussian_integral(2 * sharpness);
}

// The product of two lobes, which have the axes p and q and the sharpness a and b. It is a lobe of sharpness
// l = |a p + b q|, scaled by e^(l - a - b). `apart` is 1 - dot(p, q).
template <std::floating_point T>
struct ProductShape {
  T sharpness;
  T scale;
};
template <std::floating_point T>
ProductShape<T> gaussian_product_shape(T a, T b, T apart) {
  const T sum = a + b;
  const T sharpness = std::sqrt(std::max(sum * sum - 2 * a * b * apart, T(0)));
  const T drop = sum > 0 ? -2 * a * b * apart / (sharpness + sum) : T(0);  // l - a - b
  return {sharpness, std::exp(drop)};
}

// Returns the integral of the product of two lobes of amplitude 1: 2 pi e^(l - a - b) (1 - e^(-2 l)) / l.
// This form never overflows, unlike 4 pi e^(-a - b) sinh(l) / l.
template <std::floating_point T>
T gaussian_product_integral(T a, T b, T apart) {
  const ProductShape<T> shape = gaussian_product_shape(a, b, apart);
  return shape.scale * gaussian_integral(shape.sharpness);
}

constexpr Vec3 by_channel(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

inline Vec3 value(const SphericalGaussian& g, Vec3 s) {
  return g.amplitude * gaussian_value(g.axis, g.sharpness, s);
}

inline Vec3 integral(const SphericalGaussian& g) {
  return g.amplitude * gaussian_integral(g.sharpness);
}

inline Vec3 product_integral(const SphericalGaussian& a, const SphericalGaussian& b) {
  return by_channel(a.amplitude, b.amplitude) *
         gaussian_product_integral(a.sharpness, b.sharpness, one_minus_cosine(a.axis, b.axis));
}

inline SphericalGaussian product(const SphericalGaussian& a, const SphericalGaussian& b) {
  const ProductShape<float> shape =
      gaussian_product_shape(a.sharpness, b.sharpness, one_minus_cosine(a.axis, b.axis));
  const Vec3 axis = normalised(a.axis * a.sharpness + b.axis * b.sharpness);
  return {dot(axis, axis) > 0 ? axis : a.axis, shape.sharpness,
          by_channel(a.amplitude, b.amplitude) * shape.scale};
}

// Returns 1 - c, where c is the mean cosine to the lobe's axis, weighted by the lobe: 1 - (coth(sharpness) -
// 1 / sharpness).
template <std::floating_point T>
T gaussian_spread(T sharpness) {
  if (sharpness < T(0.01)) return 1 - sharpness / 3;
  const T e = std::exp(-2 * sharpness);
  return 1 / sharpness - 2 * e / (1 - e);
}

// The inverse of gaussian_spread: returns the sharpness of a lobe with this spread, which must be in (0, 1].
// Starts from the estimate of A. Banerjee (2005), and improves it by two Newton steps.
template <std::floating_point T>
T gaussian_sharpness_of_spread(T spread) {
  const T mean = 1 - spread;
  T sharpness = mean * (3 - mean * mean) / (spread * (1 + mean));
  if (sharpness < T(0.01)) return 3 * mean;
  for (int step = 0; step < 2; ++step) {
    const T e = std::exp(-2 * sharpness);
    const T slope = 4 * e / ((1 - e) * (1 - e)) - 1 / (sharpness * sharpness);
    const T moved = sharpness - (gaussian_spread(sharpness) - spread) / slope;
    sharpness = moved > 0 ? moved : sharpness / 2;
  }
  return sharpness;
}

// Approximates the convolution of `a` with the zonal filter `b`, which is not exactly a lobe. Returns the
// lobe around the axis of `a` that has the same integral and mean cosine as the exact convolution.
inline SphericalGaussian convolution(const SphericalGaussian& a, const SphericalGaussian& b) {
  const float spread_a = gaussian_spread(a.sharpness), spread_b = gaussian_spread(b.sharpness);
  const float sharpness = gaussian_sharpness_of_spread(spread_a + spread_b - spread_a * spread_b);
  const float mass = gaussian_integral(a.sharpness) * gaussian_integral(b.sharpness);
  return {a.axis, sharpness, by_channel(a.amplitude, b.amplitude) * (mass / gaussian_integral(sharpness))};
}

// Returns the factors by which convolution with a lobe of integral 1 scales bands 0 to 4 of a function on the
// sphere. The factors are the ratios i_l / i_0 of the modified spherical Bessel functions. The upward
// recurrence of these functions loses digits for small sharpness. So this function uses the continued
// fraction of i_(l+1) / i_l, which does not lose digits.
template <std::floating_point T>
std::array<T, 5> gaussian_bands(T sharpness) {
  std::array<T, 5> band{1, 1 - gaussian_spread(sharpness)};
  if (sharpness > 16) {
    for (int l = 1; l < 4; ++l) band[l + 1] = band[l - 1] - (2 * l + 1) / sharpness * band[l];
    return band;
  }
  T ratio = 0;
  std::array<T, 4> ratios{};
  for (int l = 40; l >= 0; --l) {
    ratio = sharpness / (2 * l + 3 + sharpness * ratio);
    if (l < 4) ratios[l] = ratio;
  }
  for (int l = 0; l < 4; ++l) band[l + 1] = band[l] * ratios[l];
  return band;
}

// Returns the irradiance of a lobe of integral 1 on a surface; cosine is dot(axis, n). This function uses the
// zonal harmonics of the clamped cosine up to band 4; odd bands above 1 are 0. Relative to the irradiance of
// a perpendicular light, its error is at most 1.5e-3 at sharpness 6, and at most 1e-2 at sharpness 16.
inline float gaussian_unit_irradiance_bands(float sharpness, float cosine) {
  const std::array<float, 5> band = gaussian_bands(sharpness);
  const float c2 = cosine * cosine;
  const float even =
      5.0f / 16 * band[2] * (1.5f * c2 - 0.5f) - 3.0f / 32 * band[4] * ((4.375f * c2 - 3.75f) * c2 + 0.375f);
  return std::max(0.25f + 0.5f * band[1] * cosine + even, 0.0f);
}

// S. Hill's fit. From this sharpness on, its error is at most 1.6e-2, relative to the irradiance of a
// perpendicular light. Below this sharpness, the fit is not defined, so the bands are used instead.
inline constexpr float hill_min_sharpness = float(NOOK_FITTED_IRRADIANCE_MIN_SHARPNESS);
inline float gaussian_unit_irradiance_fitted(float sharpness, float cosine) {
  if (sharpness < hill_min_sharpness) return gaussian_unit_irradiance_bands(sharpness, cosine);
  constexpr float c0 = float(NOOK_FITTED_IRRADIANCE_SLOPE), c1 = 1 / (4 * c0);
  const float e1 = std::exp(-sharpness), e2 = e1 * e1, inverse = 1 / sharpness;
  const float rest = inverse - 2 * e2;  // 1 - scale; above 0 for any sharpness
  const float bias = (e1 - e2) * inverse - e2;
  const float x = std::sqrt(rest);
  const float x0 = c0 * cosine, x1 = c1 * x, n = x0 + x1;
  const float y = std::abs(x0) <= x1 ? n * n / x : std::clamp(cosine, 0.0f, 1.0f);
  return std::max((1 - rest) * y + bias, 0.0f);
}

// The most accurate form uses the bands up to this sharpness, and S. Hill's fit above it.
inline constexpr float bands_max_sharpness = float(NOOK_BANDS_MAX_SHARPNESS);
inline float gaussian_unit_irradiance_best(float sharpness, float cosine) {
  return sharpness <= bands_max_sharpness ? gaussian_unit_irradiance_bands(sharpness, cosine)
                                          : gaussian_unit_irradiance_fitted(sharpness, cosine);
}

// A lobe around n that approximates the clamped cosine max(dot(n, s), 0), with the values of B. Karis that
// were also used in the game The Order: 1886. The inner product of a light with this lobe is the cheapest
// approximation of irradiance. It is never 0, even for light from behind.
inline constexpr float cosine_lobe_sharpness = float(NOOK_COSINE_LOBE_SHARPNESS);
inline constexpr float cosine_lobe_amplitude = float(NOOK_COSINE_LOBE_AMPLITUDE);
inline float gaussian_irradiance_inner_product(Vec3 axis, float sharpness, Vec3 n) {
  return cosine_lobe_amplitude *
         gaussian_product_integral(sharpness, cosine_lobe_sharpness, one_minus_cosine(axis, n));
}

}  // namespace nook
