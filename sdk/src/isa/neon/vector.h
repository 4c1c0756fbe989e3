// Four floats for NEON (Advanced SIMD), which every 64-bit ARM processor has.
#pragma once

#include <arm_neon.h>

#include <cstdint>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/simd_polynomials.h"

namespace nook::isa_neon {

inline constexpr Isa isa = Isa::neon;

struct Float {
  float32x4_t v;
  Float() = default;
  Float(float32x4_t a) : v(a) {}
  explicit Float(float a) : v(vdupq_n_f32(a)) {}
};
inline constexpr std::uint32_t width = 4;

inline Float broadcast(float a) {
  return vdupq_n_f32(a);
}
inline Float load(const float* p) {
  return vld1q_f32(p);
}
// A vector of 32-bit integers.
struct Whole {
  int32x4_t v;
};
struct CodePair {
  int16x8_t v;
};
inline Whole whole_zero() {
  return {vdupq_n_s32(0)};
}
inline CodePair code_pair(std::int32_t low, std::int32_t high) {
  return {vreinterpretq_s16_s32(vdupq_n_s32(low | high))};
}
inline Whole add_products(const std::int16_t* p, CodePair codes, Whole sum) {
  const int16x8_t pairs = vld1q_s16(p);
  const int32x4_t products =
      vpaddq_s32(vmull_s16(vget_low_s16(pairs), vget_low_s16(codes.v)), vmull_high_s16(pairs, codes.v));
  return {vaddq_s32(sum.v, products)};
}
inline Float number(Whole a) {
  return vcvtq_f32_s32(a.v);
}
inline void load_pairs(const std::int16_t* p, Float& first, Float& second) {
  const int16x4x2_t pairs = vld2_s16(p);
  first = vcvtq_f32_s32(vmovl_s16(pairs.val[0]));
  second = vcvtq_f32_s32(vmovl_s16(pairs.val[1]));
}
inline void store_codes(std::int32_t* low, std::int32_t* high, Float a) {
  const int32x4_t code = vcvtnq_s32_f32(a.v);
  vst1q_s32(low, vandq_s32(code, vdupq_n_s32(0xffff)));
  vst1q_s32(high, vshlq_n_s32(code, 16));
}
inline void store(float* p, Float a) {
  vst1q_f32(p, a.v);
}

inline Float operator+(Float a, Float b) {
  return vaddq_f32(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return vsubq_f32(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return vmulq_f32(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return vdivq_f32(a.v, b.v);
}
inline Float fma(Float a, Float b, Float c) {
  return vfmaq_f32(c.v, a.v, b.v);
}
// If one operand is NaN, min and max return the other operand. The x86 versions return the second operand if
// either is NaN. For all callers the result is the same, because their second operand is never NaN.
inline Float min(Float a, Float b) {
  return vminnmq_f32(a.v, b.v);
}
inline Float max(Float a, Float b) {
  return vmaxnmq_f32(a.v, b.v);
}

struct Mask {
  uint32x4_t v;
};
inline Mask less(Float a, Float b) {
  return {vcltq_f32(a.v, b.v)};
}
// Returns a mask with one bit for each lane; the first lane has the lowest bit.
inline std::uint32_t bits(Mask m) {
  const std::uint32_t of_lanes[4] = {1, 2, 4, 8};
  return vaddvq_u32(vandq_u32(m.v, vld1q_u32(of_lanes)));
}
inline Float select(Mask m, Float yes, Float no) {
  return vbslq_f32(m.v, yes.v, no.v);
}

inline Float sqrt(Float a) {
  return vsqrtq_f32(a.v);
}

// The processor's estimate r of 1 / sqrt(a) is accurate to 8 bits. The functions below correct it: they
// multiply by a power of u = a r^2 = 1 - e, where |e| < 0.008. They compute this power with three terms of
// its series in e. The terms are rewritten in powers of u, which saves one multiplication. The relative error
// is 5/16 e^3 for the power -1/2, which is below 2e-7. It is 35/16 e^3 for the power -3/2, which is below
// 2e-6.

// Returns (1 - e)^(-1/2) for u = 1 - e.
inline Float inverse_root_near_one(Float u) {
  return fma(fma(Float(3.0f / 8), u, Float(-5.0f / 4)), u, Float(15.0f / 8));
}
inline Float rsqrt(Float a) {
  const Float r = vrsqrteq_f32(a.v);
  return r * inverse_root_near_one(a * r * r);
}
inline Float sqrt_positive(Float a) {
  const Float r = vrsqrteq_f32(a.v);
  const Float root = a * r;
  return root * inverse_root_near_one(root * r);
}
// The lower limit of `a` avoids 0 * infinity.
inline Float power_three_halves(Float a) {
  return a * sqrt_positive(max(a, Float(1e-30f)));
}
inline Float rsqrt_cubed(Float a, float scale) {
  const Float r = vrsqrteq_f32(a.v);
  const Float r2 = r * r;
  const Float u = a * r2;
  const Float p =
      fma(fma(Float(scale * (15.0f / 8)), u, Float(scale * (-21.0f / 4))), u, Float(scale * (35.0f / 8)));
  return r * (r2 * p);
}

inline void split(Float a, Float& exponent, Float& mantissa) {
  const int32x4_t bits = vreinterpretq_s32_f32(a.v);
  // 0x3f3504f3 holds the bits of 1/sqrt(2). It is subtracted before the shift, so that mantissas of sqrt(2)
  // and above get the next exponent.
  const int32x4_t e = vshrq_n_s32(vsubq_s32(bits, vdupq_n_s32(0x3f3504f3)), 23);
  exponent = vcvtq_f32_s32(e);
  mantissa = vreinterpretq_f32_s32(vsubq_s32(bits, vshlq_n_s32(e, 23)));
}
inline Float nearest(Float a) {
  return vrndnq_f32(a.v);
}
inline Float times_power_of_two(Float a, Float n) {
  const int32x4_t e = vshlq_n_s32(vaddq_s32(vcvtq_s32_f32(n.v), vdupq_n_s32(127)), 23);
  return a * Float(vreinterpretq_f32_s32(e));
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
  return vaddvq_f32(a.v);
}

// The pose kernels (shadow_kernels_pose_simd.inl) use vectors of four floats.
using Four = Float;
// Returns four floats whose sum is the sum of all lanes.
inline Four folded(Float a) {
  return a;
}
inline Four load_four(const float* p) {
  return load(p);
}
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  const float32x4_t ab_even = vtrn1q_f32(a.v, b.v), ab_odd = vtrn2q_f32(a.v, b.v);
  const float32x4_t cd_even = vtrn1q_f32(c.v, d.v), cd_odd = vtrn2q_f32(c.v, d.v);
  const auto low = [](float32x4_t x, float32x4_t y) {
    return vreinterpretq_f32_f64(vtrn1q_f64(vreinterpretq_f64_f32(x), vreinterpretq_f64_f32(y)));
  };
  const auto high = [](float32x4_t x, float32x4_t y) {
    return vreinterpretq_f32_f64(vtrn2q_f64(vreinterpretq_f64_f32(x), vreinterpretq_f64_f32(y)));
  };
  a = low(ab_even, cd_even);
  b = low(ab_odd, cd_odd);
  c = high(ab_even, cd_even);
  d = high(ab_odd, cd_odd);
}

#include "sdk/src/isa/eight_of_fours.inl"

}  // namespace nook::isa_neon
