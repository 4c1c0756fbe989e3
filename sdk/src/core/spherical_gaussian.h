// Spherical Gaussians, lobes for short, and their closed forms:
//   G(s) = amplitude exp(sharpness (dot(axis, s) - 1)).
// Every function is safe from sharpness 0, a constant over the sphere, to far beyond what float directions
// resolve: differences of large numbers are taken before exponentials, never after.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

#include "core/vec.h"

namespace nook {

struct SphericalGaussian {
  Vec3 axis{0, 0, 1};   // unit
  float sharpness = 0;  // >= 0
  Vec3 amplitude;       // linear RGB
};

// 1 - dot(a, b) of unit vectors, without the cancellation of nearly equal ones.
constexpr float one_minus_cosine(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return 0.5f * dot(d, d);
}

// G(s) at amplitude 1; s unit.
inline float gaussian_value(Vec3 axis, float sharpness, Vec3 s) {
  return std::exp(-sharpness * one_minus_cosine(axis, s));
}

// Integral of G over the sphere at amplitude 1: 2 pi (1 - e^(-2 sharpness)) / sharpness.
template <std::floating_point T>
T gaussian_integral(T sharpness) {
  constexpr T pi = std::numbers::pi_v<T>;
  if (sharpness < T(1e-15)) return 4 * pi;
  return -2 * pi * std::expm1(-2 * sharpness) / sharpness;
}

// Integral of G^2, itself a lobe of twice the sharpness: pi (1 - e^(-4 sharpness)) / sharpness.
template <std::floating_point T>
T gaussian_square_integral(T sharpness) {
  return gaussian_integral(2 * sharpness);
}

// The product of lobes of sharpness a and b with `apart` = 1 - cosine between their axes is a lobe of
// sharpness l = |a p + b q|, scaled by e^(l - a - b).
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

// Integral of the product, at amplitudes 1: 2 pi e^(l - a - b) (1 - e^(-2 l)) / l, the form that never
// overflows, where 4 pi e^(-a - b) sinh(l) / l would.
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

// 1 - the mean cosine to its axis of a lobe's mass: 1 - (coth(sharpness) - 1 / sharpness).
template <std::floating_point T>
T gaussian_spread(T sharpness) {
  if (sharpness < T(0.01)) return 1 - sharpness / 3;
  const T e = std::exp(-2 * sharpness);
  return 1 / sharpness - 2 * e / (1 - e);
}

// The sharpness whose gaussian_spread is `spread`, in (0, 1]: A. Banerjee's estimate (2005) and two Newton
// steps.
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

// a blurred by b, a zonal filter: the lobe round a's axis whose integral and mean cosine are the true
// convolution's, which is no lobe itself.
inline SphericalGaussian convolution(const SphericalGaussian& a, const SphericalGaussian& b) {
  const float spread_a = gaussian_spread(a.sharpness), spread_b = gaussian_spread(b.sharpness);
  const float sharpness = gaussian_sharpness_of_spread(spread_a + spread_b - spread_a * spread_b);
  const float mass = gaussian_integral(a.sharpness) * gaussian_integral(b.sharpness);
  return {a.axis, sharpness, by_channel(a.amplitude, b.amplitude) * (mass / gaussian_integral(sharpness))};
}

// The clamped cosine max(dot(n, s), 0) as a lobe round n (B. Karis' values, used by The Order: 1886).
inline constexpr float cosine_lobe_sharpness = 2.133f;
inline constexpr float cosine_lobe_amplitude = 1.17f;

// Irradiance of a lobe of amplitude 1 on a surface with normal n: the inner product with the cosine's lobe.
inline float gaussian_irradiance_inner_product(Vec3 axis, float sharpness, Vec3 n) {
  return cosine_lobe_amplitude *
         gaussian_product_integral(sharpness, cosine_lobe_sharpness, one_minus_cosine(axis, n));
}

// Below this sharpness the fit leaves its range, and three bands of spherical harmonics are nearer the truth.
inline constexpr float hill_min_sharpness = 1.25f;

// Irradiance of a lobe of integral 1; cosine is dot(axis, n). S. Hill's fit; the three zonal harmonics of the
// clamped cosine below hill_min_sharpness.
inline float gaussian_unit_irradiance_fitted(float sharpness, float cosine) {
  if (sharpness < hill_min_sharpness) {
    const float mean = 1 - gaussian_spread(sharpness);
    const float second = sharpness < 0.05f ? sharpness * sharpness / 15 : 1 - 3 * mean / sharpness;
    return std::max(0.25f + 0.5f * mean * cosine + 0.3125f * second * (1.5f * cosine * cosine - 0.5f), 0.0f);
  }
  constexpr float c0 = 0.36f, c1 = 1 / (4 * c0);
  const float e1 = std::exp(-sharpness), e2 = e1 * e1, inverse = 1 / sharpness;
  const float scale = 1 + 2 * e2 - inverse;
  const float bias = (e1 - e2) * inverse - e2;
  const float x = std::sqrt(1 - scale);
  const float x0 = c0 * cosine, x1 = c1 * x, n = x0 + x1;
  const float y = std::abs(x0) <= x1 ? n * n / x : std::clamp(cosine, 0.0f, 1.0f);
  return std::max(scale * y + bias, 0.0f);
}

inline float gaussian_irradiance_fitted(Vec3 axis, float sharpness, Vec3 n) {
  return gaussian_integral(sharpness) * gaussian_unit_irradiance_fitted(sharpness, dot(axis, n));
}

}  // namespace nook
