// The operations of the SIMD vectors, for float and double. A formula that is a template over its number type
// can then be used for the scalar reference, for tests in double precision and for every instruction set.
#pragma once

#include <cmath>
#include <concepts>

namespace nook {

// Returns a * b + c. std::fma is not used, because it is a slow library call on processors without an FMA
// instruction, and no caller needs the single rounding.
template <std::floating_point T>
constexpr T fma(T a, T b, T c) {
  return a * b + c;
}
template <std::floating_point T>
constexpr T min(T a, T b) {
  return a < b ? a : b;  // returns b if either is NaN, like the x86 instruction
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
// Returns the square root of `a`, for a >= 1e-30. The SIMD versions of this function and of the next two use
// the processor's fast estimates, with a relative error of up to 1e-4.
template <std::floating_point T>
T sqrt_positive(T a) {
  return std::sqrt(a);
}
// Returns a^(3/2). If rounding made `a` negative, returns 0.
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
// Returns base^exponent. `base` must be >= 0, and `exponent` > 0.
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
// Returns the arc cosine of `a`, which must be in [-1, 1].
template <std::floating_point T>
T arc_cosine(T a) {
  return std::acos(a);
}

}  // namespace nook
