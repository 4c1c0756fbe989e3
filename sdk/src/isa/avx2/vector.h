// Eight floats for AVX2 and FMA. Only include this file in translation units that are compiled for AVX2 and
// FMA.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/simd_polynomials.h"

namespace nook::isa_avx2 {

inline constexpr Isa isa = Isa::avx2;

struct Float {
  __m256 v;
  Float() = default;
  Float(__m256 a) : v(a) {}
  explicit Float(float a) : v(_mm256_set1_ps(a)) {}
};
inline constexpr std::uint32_t width = 8;

inline Float broadcast(float a) {
  return _mm256_set1_ps(a);
}
inline Float load(const float* p) {
  return _mm256_loadu_ps(p);
}
// A vector of 32-bit integers.
struct Whole {
  __m256i v;
};
struct CodePair {
  __m256i v;
};
inline Whole whole_zero() {
  return {_mm256_setzero_si256()};
}
inline CodePair code_pair(std::int32_t low, std::int32_t high) {
  return {_mm256_or_si256(_mm256_set1_epi32(low), _mm256_set1_epi32(high))};
}
inline Whole add_products(const std::int16_t* p, CodePair codes, Whole sum) {
  const __m256i pairs = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  return {_mm256_add_epi32(sum.v, _mm256_madd_epi16(pairs, codes.v))};
}
inline Float number(Whole a) {
  return _mm256_cvtepi32_ps(a.v);
}
inline void load_pairs(const std::int16_t* p, Float& first, Float& second) {
  const __m256i pairs = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  first = _mm256_cvtepi32_ps(_mm256_srai_epi32(_mm256_slli_epi32(pairs, 16), 16));
  second = _mm256_cvtepi32_ps(_mm256_srai_epi32(pairs, 16));
}
inline void store_codes(std::int32_t* low, std::int32_t* high, Float a) {
  const __m256i code = _mm256_cvtps_epi32(a.v);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(low), _mm256_and_si256(code, _mm256_set1_epi32(0xffff)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(high), _mm256_slli_epi32(code, 16));
}
inline void store(float* p, Float a) {
  _mm256_storeu_ps(p, a.v);
}

inline Float operator+(Float a, Float b) {
  return _mm256_add_ps(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return _mm256_sub_ps(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return _mm256_mul_ps(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return _mm256_div_ps(a.v, b.v);
}
inline Float fma(Float a, Float b, Float c) {
  return _mm256_fmadd_ps(a.v, b.v, c.v);
}
inline Float min(Float a, Float b) {
  return _mm256_min_ps(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return _mm256_max_ps(a.v, b.v);
}

struct Mask {
  __m256 v;
};
inline Mask less(Float a, Float b) {
  return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)};
}
// Returns a mask with one bit for each lane; the first lane has the lowest bit.
inline std::uint32_t bits(Mask m) {
  return std::uint32_t(_mm256_movemask_ps(m.v));
}
inline Float select(Mask m, Float yes, Float no) {
  return _mm256_blendv_ps(no.v, yes.v, m.v);
}

inline Float sqrt(Float a) {
  return _mm256_sqrt_ps(a.v);
}
// Uses the exact square root. It costs less than an estimate with a Newton step, because it runs on the
// processor's divider. The divider is otherwise idle, and works in parallel with the other execution ports.
inline Float sqrt_positive(Float a) {
  return _mm256_sqrt_ps(a.v);
}
inline Float power_three_halves(Float a) {
  return a * Float(_mm256_sqrt_ps(_mm256_max_ps(a.v, _mm256_setzero_ps())));
}
// The processor's estimate is accurate to 12 bits. One Newton step makes it accurate to 22 bits.
inline Float rsqrt(Float a) {
  const __m256 t = _mm256_rsqrt_ps(a.v);
  const __m256 residual = _mm256_fnmadd_ps(_mm256_mul_ps(a.v, t), t, _mm256_set1_ps(1.0f));
  return _mm256_fmadd_ps(_mm256_mul_ps(t, _mm256_set1_ps(0.5f)), residual, t);
}
// With the estimate r and e = 1 - a r^2, a^(-3/2) = r^3 (1 - e)^(-3/2), which is about r^3 (1 + 3/2 e). The
// error is of the order of e^2, about 1e-6.
inline Float rsqrt_cubed(Float a, float scale) {
  const Float r = _mm256_rsqrt_ps(a.v);
  const Float r2 = r * r;
  return (Float(1.5f * scale) * r) * (r2 * Float(_mm256_fnmadd_ps(a.v, r2.v, _mm256_set1_ps(5.0f / 3.0f))));
}

inline void split(Float a, Float& exponent, Float& mantissa) {
  const __m256i bits = _mm256_castps_si256(a.v);
  // 0x3f3504f3 holds the bits of 1/sqrt(2). It is subtracted before the shift, so that mantissas of sqrt(2)
  // and above get the next exponent.
  const __m256i e = _mm256_srai_epi32(_mm256_sub_epi32(bits, _mm256_set1_epi32(0x3f3504f3)), 23);
  exponent = _mm256_cvtepi32_ps(e);
  mantissa = _mm256_castsi256_ps(_mm256_sub_epi32(bits, _mm256_slli_epi32(e, 23)));
}
inline Float nearest(Float a) {
  return _mm256_round_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
// Adds n to the exponent bits, which are above the mantissa. `a` and the result must be normal.
inline Float times_power_of_two(Float a, Float n) {
  const __m256i e = _mm256_slli_epi32(_mm256_cvtps_epi32(n.v), 23);
  return _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(a.v), e));
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
  const __m128 half = _mm_add_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
  const __m128 pairs = _mm_add_ps(half, _mm_movehl_ps(half, half));
  return _mm_cvtss_f32(_mm_add_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
}

#include "sdk/src/isa/x86_four.inl"

// Returns four floats whose sum is the sum of all lanes.
inline Four folded(Float a) {
  return _mm_add_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
}

#include "sdk/src/isa/x86_eight.inl"

}  // namespace nook::isa_avx2
