// The operations of the SIMD vectors for float and double. A formula over a number type then serves the
// scalar reference, the double precision of the tests and every instruction set.
#pragma once

#include <cmath>
#include <concepts>

namespace nook {

// Returns a * b + c. Without an FMA instruction std::fma is a slow library call, and no caller needs its
// single rounding.
template <std::floating_point T>
constexpr T fma(T a, T b, T c) {
  return a * b + c;
}
template <std::floating_point T>
constexpr T min(T a, T b) {
  return a < b ? a : b;  // b if either is NaN, as in the x86 instruction
}
template <std::floating_point T>
constexpr T max(T a, T b) {
  return a > b ? a : b;
}
template <std::floating_point T>
constexpr bool less(T a, T b) {
  return a < b;
}
template <std::floating_point T>
constexpr T select(bool condition, T yes, T no) {
  return condition ? yes : no;
}
template <std::floating_point T>
T sqrt(T a) {
  return std::sqrt(a);
}
template <std::floating_point T>
T rsqrt(T a) {
  return 1 / std::sqrt(a);
}
// In the SIMD versions, the next three functions use the processor's estimates, within 1e-4 of the value.
// This one is the square root of a >= 1e-30.
template <std::floating_point T>
T sqrt_positive(T a) {
  return std::sqrt(a);
}
// Returns a^(3/2), or 0 for an a that rounding made negative.
template <std::floating_point T>
T power_three_halves(T a) {
  return a > 0 ? a * std::sqrt(a) : T(0);
}
// Returns scale * a^(-3/2) for a >= 1e-30.
template <std::floating_point T>
T rsqrt_cubed(T a, float scale) {
  const T t = 1 / std::sqrt(a);
  return scale * t * t * t;
}
// Requires base >= 0 and exponent > 0.
template <std::floating_point T>
T power(T base, T exponent) {
  return std::pow(base, exponent);
}
template <std::floating_point T>
constexpr T sum(T a) {
  return a;
}
template <std::floating_point T>
T exponential(T a) {
  return std::exp(a);
}
// The caller clamps a to [-1, 1].
template <std::floating_point T>
T arc_cosine(T a) {
  return std::acos(a);
}

}  // namespace nook
