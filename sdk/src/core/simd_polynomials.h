// Mathematical functions for which processors have no instruction, for a SIMD vector type F of one
// instruction set. F must have the operations of core/simd_scalar.h and
//   split(x, exponent, mantissa), which sets x = mantissa * 2^exponent with mantissa in [1/sqrt(2), sqrt(2)),
//   where x must be normal and > 0,
//   times_power_of_two(a, n), which returns a * 2^n for an integer n in [-126, 127], where `a` and the result
//   must be normal, and
//   nearest(a), which returns the integer nearest to `a`.
// The polynomials interpolate the functions at Chebyshev nodes, so each is close to the best polynomial of
// its degree.
#pragma once

namespace nook::simd {

// Returns the logarithm to base 2. The absolute error is at most 1e-6 plus rounding.
template <class F>
F log2_of(F a) {
  F exponent, mantissa;
  split(a, exponent, mantissa);
  const F f = mantissa - F(1.0f);
  F p = F(0.168186591f);
  p = fma(p, f, F(-0.267963871f));
  p = fma(p, f, F(0.296119557f));
  p = fma(p, f, F(-0.359524455f));
  p = fma(p, f, F(0.480613125f));
  p = fma(p, f, F(-0.721360179f));
  p = fma(p, f, F(1.44269652f));
  return fma(p, f, exponent);
}

// Returns 2^a for a <= 127. The relative error is at most 1e-7 plus rounding. The result is at least 2^-126,
// so it is never subnormal.
template <class F>
F exp2_of_bounded(F a) {
  const F x = max(a, F(-126.0f));
  const F whole = nearest(x);
  const F f = x - whole;
  F p = F(0.00133908634f);
  p = fma(p, f, F(0.00967603192f));
  p = fma(p, f, F(0.0555035711f));
  p = fma(p, f, F(0.240221075f));
  p = fma(p, f, F(0.693147188f));
  p = fma(p, f, F(1.0f));
  return times_power_of_two(p, whole);
}

// Returns 2^a for any a. The result is at most 2^127.
template <class F>
F exp2_of(F a) {
  return exp2_of_bounded(min(a, F(127.0f)));
}

// Returns base^exponent. The relative error is at most 1e-5 for base in [1e-6, 1e3] and exponent in (0, 4].
// The error is proportional to the exponent. For base 0, the result is 0.
template <class F>
F power_of(F base, F exponent) {
  const F smallest(1e-37f);
  return select(less(smallest, base), exp2_of(exponent * log2_of(max(base, smallest))), F(0.0f));
}

template <class F>
F exponential_of(F a) {
  return exp2_of(a * F(1.44269504f));
}

// Returns the arc cosine for a in [-1, 1] (Abramowitz and Stegun 4.4.46). The absolute error is 2e-8 plus
// rounding.
template <class F>
F arc_cosine_of(F a) {
  const F x = max(a, F(0.0f) - a);
  F p = F(-0.0012624911f);
  p = fma(p, x, F(0.0066700901f));
  p = fma(p, x, F(-0.0170881256f));
  p = fma(p, x, F(0.0308918810f));
  p = fma(p, x, F(-0.0501743046f));
  p = fma(p, x, F(0.0889789874f));
  p = fma(p, x, F(-0.2145988016f));
  p = fma(p, x, F(1.5707963050f));
  const F r = sqrt(max(F(1.0f) - x, F(0.0f))) * p;
  return select(less(a, F(0.0f)), F(3.14159265f) - r, r);
}

}  // namespace nook::simd
