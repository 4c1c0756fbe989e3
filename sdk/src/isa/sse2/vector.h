// Four floats for SSE2, which every x86-64 processor has.
#pragma once

#include <emmintrin.h>

#include <cstdint>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/simd_polynomials.h"

namespace nook::isa_sse2 {

inline constexpr Isa isa = Isa::sse2;

struct Float {
  __m128 v;
  Float() = default;
  Float(__m128 a) : v(a) {}
  explicit Float(float a) : v(_mm_set1_ps(a)) {}
};
inline constexpr std::uint32_t width = 4;

inline Float broadcast(float a) {
  return _mm_set1_ps(a);
}
inline Float load(const float* p) {
  return _mm_loadu_ps(p);
}
// A vector of 32-bit integers.
struct Whole {
  __m128i v;
};
struct CodePair {
  __m128i v;
};
inline Whole whole_zero() {
  return {_mm_setzero_si128()};
}
inline CodePair code_pair(std::int32_t low, std::int32_t high) {
  return {_mm_set1_epi32(low | high)};
}
inline Whole add_products(const std::int16_t* p, CodePair codes, Whole sum) {
  const __m128i pairs = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  return {_mm_add_epi32(sum.v, _mm_madd_epi16(pairs, codes.v))};
}
inline Float number(Whole a) {
  return _mm_cvtepi32_ps(a.v);
}
inline void load_pairs(const std::int16_t* p, Float& first, Float& second) {
  const __m128i pairs = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  first = _mm_cvtepi32_ps(_mm_srai_epi32(_mm_slli_epi32(pairs, 16), 16));
  second = _mm_cvtepi32_ps(_mm_srai_epi32(pairs, 16));
}
inline void store_codes(std::int32_t* low, std::int32_t* high, Float a) {
  const __m128i code = _mm_cvtps_epi32(a.v);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(low), _mm_and_si128(code, _mm_set1_epi32(0xffff)));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(high), _mm_slli_epi32(code, 16));
}
inline void store(float* p, Float a) {
  _mm_storeu_ps(p, a.v);
}

inline Float operator+(Float a, Float b) {
  return _mm_add_ps(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return _mm_sub_ps(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return _mm_mul_ps(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return _mm_div_ps(a.v, b.v);
}
inline Float fma(Float a, Float b, Float c) {
  return a * b + c;
}
inline Float min(Float a, Float b) {
  return _mm_min_ps(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return _mm_max_ps(a.v, b.v);
}

struct Mask {
  __m128 v;
};
inline Mask less(Float a, Float b) {
  return {_mm_cmplt_ps(a.v, b.v)};
}
// Returns a mask with one bit for each lane; the first lane has the lowest bit.
inline std::uint32_t bits(Mask m) {
  return std::uint32_t(_mm_movemask_ps(m.v));
}
inline Float select(Mask m, Float yes, Float no) {
  return _mm_or_ps(_mm_and_ps(m.v, yes.v), _mm_andnot_ps(m.v, no.v));
}

inline Float sqrt(Float a) {
  return _mm_sqrt_ps(a.v);
}
inline Float sqrt_positive(Float a) {
  return _mm_sqrt_ps(a.v);
}
inline Float power_three_halves(Float a) {
  return a * Float(_mm_sqrt_ps(_mm_max_ps(a.v, _mm_setzero_ps())));
}
// The processor's estimate is accurate to 12 bits. One Newton step makes it accurate to 22 bits.
inline Float rsqrt(Float a) {
  const Float t = _mm_rsqrt_ps(a.v);
  return t * (Float(1.5f) - Float(0.5f) * a * t * t);
}
// With the estimate r and e = 1 - a r^2, a^(-3/2) = r^3 (1 - e)^(-3/2), which is about r^3 (1 + 3/2 e). The
// error is of the order of e^2, about 1e-6.
inline Float rsqrt_cubed(Float a, float scale) {
  const Float r = _mm_rsqrt_ps(a.v);
  const Float r2 = r * r;
  return (Float(1.5f * scale) * r) * (r2 * (Float(5.0f / 3.0f) - a * r2));
}

inline void split(Float a, Float& exponent, Float& mantissa) {
  const __m128i bits = _mm_castps_si128(a.v);
  // 0x3f3504f3 holds the bits of 1/sqrt(2). It is subtracted before the shift, so that mantissas of sqrt(2)
  // and above get the next exponent.
  const __m128i e = _mm_srai_epi32(_mm_sub_epi32(bits, _mm_set1_epi32(0x3f3504f3)), 23);
  exponent = _mm_cvtepi32_ps(e);
  mantissa = _mm_castsi128_ps(_mm_sub_epi32(bits, _mm_slli_epi32(e, 23)));
}
inline Float nearest(Float a) {
  return _mm_cvtepi32_ps(_mm_cvtps_epi32(a.v));
}
// Adds n to the exponent bits, which are above the mantissa. `a` and the result must be normal.
inline Float times_power_of_two(Float a, Float n) {
  const __m128i e = _mm_slli_epi32(_mm_cvtps_epi32(n.v), 23);
  return _mm_castsi128_ps(_mm_add_epi32(_mm_castps_si128(a.v), e));
}
inline Float power(Float base, Float exponent) {
  return simd::power_of(base, exponent);
}
inline Float exponential(Float a) {
  return simd::exponential_of(a);
}
inline Float arc_cosine(Float a) {
  return simd::arc_cosine_of(a);
}
inline float sum(Float a) {
  const __m128 pairs = _mm_add_ps(a.v, _mm_movehl_ps(a.v, a.v));
  return _mm_cvtss_f32(_mm_add_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
}

#include "sdk/src/isa/x86_four.inl"

// Returns four floats whose sum is the sum of all lanes.
inline Four folded(Float a) {
  return a.v;
}

#include "sdk/src/isa/eight_of_fours.inl"

}  // namespace nook::isa_sse2
