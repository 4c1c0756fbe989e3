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
// Square root of a >= 0 to about 1e-5 of its value; exact here, an estimate with at most one Newton step in
// SIMD.
template <std::floating_point T>
T sqrt_fast(T a) {
  return std::sqrt(a);
}
// base >= 0, exponent > 0.
template <std::floating_point T>
T power(T base, T exponent) {
  return std::pow(base, exponent);
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
