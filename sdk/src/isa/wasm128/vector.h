// Four floats for the fixed-width SIMD of WebAssembly, which has no multiply-add instruction and no estimates
// of roots.
#pragma once

#include <wasm_simd128.h>

#include <cstdint>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/simd_polynomials.h"

namespace nook::isa_wasm128 {

inline constexpr Isa isa = Isa::wasm128;

struct Float {
  v128_t v;
  Float() = default;
  Float(v128_t a) : v(a) {}
  explicit Float(float a) : v(wasm_f32x4_splat(a)) {}
};
inline constexpr std::uint32_t width = 4;

inline Float broadcast(float a) {
  return wasm_f32x4_splat(a);
}
inline Float load(const float* p) {
  return wasm_v128_load(p);
}
// A vector of 32-bit integers.
struct Whole {
  v128_t v;
};
struct CodePair {
  v128_t v;
};
inline Whole whole_zero() {
  return {wasm_i32x4_splat(0)};
}
inline CodePair code_pair(std::int32_t low, std::int32_t high) {
  return {wasm_i32x4_splat(low | high)};
}
inline Whole add_products(const std::int16_t* p, CodePair codes, Whole sum) {
  return {wasm_i32x4_add(sum.v, wasm_i32x4_dot_i16x8(wasm_v128_load(p), codes.v))};
}
inline Float number(Whole a) {
  return wasm_f32x4_convert_i32x4(a.v);
}
inline void load_pairs(const std::int16_t* p, Float& first, Float& second) {
  const v128_t pairs = wasm_v128_load(p);
  first = wasm_f32x4_convert_i32x4(wasm_i32x4_shr(wasm_i32x4_shl(pairs, 16), 16));
  second = wasm_f32x4_convert_i32x4(wasm_i32x4_shr(pairs, 16));
}
inline void store_codes(std::int32_t* low, std::int32_t* high, Float a) {
  const v128_t code = wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_nearest(a.v));
  wasm_v128_store(low, wasm_v128_and(code, wasm_i32x4_splat(0xffff)));
  wasm_v128_store(high, wasm_i32x4_shl(code, 16));
}
inline void store(float* p, Float a) {
  wasm_v128_store(p, a.v);
}

inline Float operator+(Float a, Float b) {
  return wasm_f32x4_add(a.v, b.v);
}
inline Float operator-(Float a, Float b) {
  return wasm_f32x4_sub(a.v, b.v);
}
inline Float operator*(Float a, Float b) {
  return wasm_f32x4_mul(a.v, b.v);
}
inline Float operator/(Float a, Float b) {
  return wasm_f32x4_div(a.v, b.v);
}
inline Float fma(Float a, Float b, Float c) {
  return a * b + c;
}
// The pseudo-minimum of (b, a) is a < b ? a : b, which is one instruction on x86. wasm_f32x4_min would take
// several instructions, because it must handle NaN and -0.
inline Float min(Float a, Float b) {
  return wasm_f32x4_pmin(b.v, a.v);
}
inline Float max(Float a, Float b) {
  return wasm_f32x4_pmax(b.v, a.v);
}

struct Mask {
  v128_t v;
};
inline Mask less(Float a, Float b) {
  return {wasm_f32x4_lt(a.v, b.v)};
}
// Returns a mask with one bit for each lane; the first lane has the lowest bit.
inline std::uint32_t bits(Mask m) {
  return wasm_i32x4_bitmask(m.v);
}
inline Float select(Mask m, Float yes, Float no) {
  return wasm_v128_bitselect(yes.v, no.v, m.v);
}

inline Float sqrt(Float a) {
  return wasm_f32x4_sqrt(a.v);
}
inline Float sqrt_positive(Float a) {
  return sqrt(a);
}
inline Float power_three_halves(Float a) {
  return a * sqrt(max(a, Float(0.0f)));
}
inline Float rsqrt(Float a) {
  return Float(1.0f) / sqrt(a);
}
// Returns scale * a^(-3/2), with one square root and one division. For `a` above 5e25, a^(3/2) overflows to
// infinity, and the result is 0.
inline Float rsqrt_cubed(Float a, float scale) {
  return Float(scale) / (a * sqrt(a));
}

inline void split(Float a, Float& exponent, Float& mantissa) {
  // 0x3f3504f3 holds the bits of 1/sqrt(2). It is subtracted before the shift, so that mantissas of sqrt(2)
  // and above get the next exponent.
  const v128_t e = wasm_i32x4_shr(wasm_i32x4_sub(a.v, wasm_i32x4_splat(0x3f3504f3)), 23);
  exponent = wasm_f32x4_convert_i32x4(e);
  mantissa = wasm_i32x4_sub(a.v, wasm_i32x4_shl(e, 23));
}
inline Float nearest(Float a) {
  return wasm_f32x4_nearest(a.v);
}
// WebAssembly's conversion to integers saturates, which takes several instructions. Instead, this adds 1.5 *
// 2^23 to n, which puts the integer value of n into the lowest bits.
inline Float times_power_of_two(Float a, Float n) {
  const v128_t bits = (n + Float(12582912.0f)).v;
  return a * Float(wasm_i32x4_shl(wasm_i32x4_add(bits, wasm_i32x4_splat(127)), 23));
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
  const Float pairs = a + Float(wasm_i32x4_shuffle(a.v, a.v, 2, 3, 0, 1));
  return wasm_f32x4_extract_lane(pairs.v, 0) + wasm_f32x4_extract_lane(pairs.v, 1);
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
  const v128_t ab_low = wasm_i32x4_shuffle(a.v, b.v, 0, 4, 1, 5),
               ab_high = wasm_i32x4_shuffle(a.v, b.v, 2, 6, 3, 7);
  const v128_t cd_low = wasm_i32x4_shuffle(c.v, d.v, 0, 4, 1, 5),
               cd_high = wasm_i32x4_shuffle(c.v, d.v, 2, 6, 3, 7);
  a = wasm_i32x4_shuffle(ab_low, cd_low, 0, 1, 4, 5);
  b = wasm_i32x4_shuffle(ab_low, cd_low, 2, 3, 6, 7);
  c = wasm_i32x4_shuffle(ab_high, cd_high, 0, 1, 4, 5);
  d = wasm_i32x4_shuffle(ab_high, cd_high, 2, 3, 6, 7);
}

#include "sdk/src/isa/eight_of_fours.inl"

}  // namespace nook::isa_wasm128
