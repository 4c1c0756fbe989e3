// Sixteen floats for AVX-512F. Only include this file in translation units that are compiled for AVX-512F.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/simd_polynomials.h"

namespace nook::isa_avx512 {

inline constexpr Isa isa = Isa::avx512;

struct Float {
  __m512 v;
  Float() = default;
  Float(__m512 a) : v(a) {}
  explicit Float(float a) : v(_mm512_set1_ps(a)) {}
};
inline constexpr std::uint32_t width = 16;

inline Float broadcast(float a) {
  return _mm512_set1_ps(a);
}
inline Float load(const float* p) {
  return _mm512_loadu_ps(p);
}
// A vector of 32-bit integers, stored as two halves, because AVX-512F cannot multiply 16-bit integers in
// 512-bit vectors.
struct Whole {
  __m256i a, b;
};
struct CodePair {
  __m256i v;
};
inline Whole whole_zero() {
  return {_mm256_setzero_si256(), _mm256_setzero_si256()};
}
inline CodePair code_pair(std::int32_t low, std::int32_t high) {
  return {_mm256_or_si256(_mm256_set1_epi32(low), _mm256_set1_epi32(high))};
}
inline Whole add_products(const std::int16_t* p, CodePair codes, Whole sum) {
  const auto* const pairs = reinterpret_cast<const __m256i*>(p);
  return {_mm256_add_epi32(sum.a, _mm256_madd_epi16(_mm256_loadu_si256(pairs), codes.v)),
          _mm256_add_epi32(sum.b, _mm256_madd_epi16(_mm256_loadu_si256(pairs + 1), codes.v))};
}
inline Float number(Whole a) {
  return _mm512_cvtepi32_ps(_mm512_inserti64x4(_mm512_castsi256_si512(a.a), a.b, 1));
}
inline void load_pairs(const std::int16_t* p, Float& first, Float& second) {
  const __m512i pairs = _mm512_loadu_si512(p);
  first = _mm512_cvtepi32_ps(_mm512_srai_epi32(_mm512_slli_epi32(pairs, 16), 16));
  second = _mm512_cvtepi32_ps(_mm512_srai_epi32(pairs, 16));
}
inline void store_codes(std::int32_t* low, std::int32_t* high, Float a) {
  const __m512i code = _mm512_cvtps_epi32(a.v);
  _mm512_storeu_si512(low, _mm512_and_si512(code, _mm512_set1_epi32(0xffff)));
  _mm512_storeu_si512(high, _mm512_slli_epi32(code, 16));
}
inline void store(float* p, Float a) {
  _mm512_storeu_ps(p, a.v);
}

inline Float operator+(Float a, Float b) {
  return _mm512_add_ps(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return _mm512_sub_ps(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return _mm512_mul_ps(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return _mm512_div_ps(a.v, b.v);
}
inline Float fma(Float a, Float b, Float c) {
  return _mm512_fmadd_ps(a.v, b.v, c.v);
}
inline Float min(Float a, Float b) {
  return _mm512_min_ps(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return _mm512_max_ps(a.v, b.v);
}

inline __mmask16 less(Float a, Float b) {
  return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ);
}
// Returns a mask with one bit for each lane; the first lane has the lowest bit.
inline std::uint32_t bits(__mmask16 m) {
  return m;
}
inline Float select(__mmask16 m, Float yes, Float no) {
  return _mm512_mask_blend_ps(m, no.v, yes.v);
}

inline Float sqrt(Float a) {
  return _mm512_sqrt_ps(a.v);
}
// The processor's estimates are accurate to 14 bits, which is a relative error of 6e-5.
inline Float sqrt_positive(Float a) {
  return a * Float(_mm512_rsqrt14_ps(a.v));
}
// The lower limit of `a` avoids 0 * infinity.
inline Float power_three_halves(Float a) {
  return a * a * Float(_mm512_rsqrt14_ps(_mm512_max_ps(a.v, _mm512_set1_ps(1e-30f))));
}
// One Newton step on the 14-bit estimate gives the precision of float.
inline Float rsqrt(Float a) {
  const __m512 t = _mm512_rsqrt14_ps(a.v);
  const __m512 residual = _mm512_fnmadd_ps(_mm512_mul_ps(a.v, t), t, _mm512_set1_ps(1.0f));
  return _mm512_fmadd_ps(_mm512_mul_ps(t, _mm512_set1_ps(0.5f)), residual, t);
}
// With the estimate r and e = 1 - a r^2, a^(-3/2) = r^3 (1 - e)^(-3/2), which is about r^3 (1 + 3/2 e). The
// error is of the order of e^2, which is below the rounding of floats.
inline Float rsqrt_cubed(Float a, float scale) {
  const Float r = _mm512_rsqrt14_ps(a.v);
  const Float r2 = r * r;
  return (Float(1.5f * scale) * r) * (r2 * Float(_mm512_fnmadd_ps(a.v, r2.v, _mm512_set1_ps(5.0f / 3.0f))));
}

inline void split(Float a, Float& exponent, Float& mantissa) {
  const __m512i bits = _mm512_castps_si512(a.v);
  // 0x3f3504f3 holds the bits of 1/sqrt(2). It is subtracted before the shift, so that mantissas of sqrt(2)
  // and above get the next exponent.
  const __m512i e = _mm512_srai_epi32(_mm512_sub_epi32(bits, _mm512_set1_epi32(0x3f3504f3)), 23);
  exponent = _mm512_cvtepi32_ps(e);
  mantissa = _mm512_castsi512_ps(_mm512_sub_epi32(bits, _mm512_slli_epi32(e, 23)));
}
inline Float nearest(Float a) {
  return _mm512_roundscale_ps(a.v, 0);
}
inline Float times_power_of_two(Float a, Float n) {
  return _mm512_scalef_ps(a.v, n.v);
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
  return _mm512_reduce_add_ps(a.v);
}

#include "sdk/src/isa/x86_four.inl"

// Returns four floats whose sum is the sum of all lanes.
inline Four folded(Float a) {
  const __m256 upper = _mm256_castpd_ps(_mm512_extractf64x4_pd(_mm512_castps_pd(a.v), 1));
  const __m256 half = _mm256_add_ps(_mm512_castps512_ps256(a.v), upper);
  return _mm_add_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1));
}

#include "sdk/src/isa/x86_eight.inl"

}  // namespace nook::isa_avx512
