// One number at a time: the vocabulary of the SIMD vectors for float and double, so that a formula written
// once over a number type serves the scalar reference, the tests' double precision and every instruction set.
#pragma once

#include <cmath>
#include <concepts>

namespace nook {

// a * b + c. Not std::fma: without an FMA instruction that is a slow library call, and no caller needs its
// one rounding.
template <std::floating_point T>
constexpr T fma(T a, T b, T c) {
  return a * b + c;
}
template <std::floating_point T>
constexpr T min(T a, T b) {
  return a < b ? a : b;  // b where either is NaN, as the x86 instruction has it
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
// SIMD answers the next three from the processor's estimates, within 1e-4 of their value.
// Square root of a >= 1e-30.
template <std::floating_point T>
T sqrt_positive(T a) {
  return std::sqrt(a);
}
// a^(3/2); 0 for what rounding made negative.
template <std::floating_point T>
T power_three_halves(T a) {
  return a > 0 ? a * std::sqrt(a) : T(0);
}
// scale * a^(-3/2), a >= 1e-30.
template <std::floating_point T>
T rsqrt_cubed(T a, float scale) {
  const T t = 1 / std::sqrt(a);
  return scale * t * t * t;
}
// base >= 0, exponent > 0.
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
// a is clamped to [-1, 1] by the caller.
template <std::floating_point T>
T arc_cosine(T a) {
  return std::acos(a);
}

}  // namespace nook
