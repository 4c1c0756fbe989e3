// One float at a time: the reference for the other instruction sets, and the fallback for processors without
// any of them.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/simd_scalar.h"

namespace nook::isa_scalar {

inline constexpr Isa isa = Isa::scalar;

using Float = float;
inline constexpr std::uint32_t width = 1;

inline Float broadcast(float a) {
  return a;
}
inline Float load(const float* p) {
  return *p;
}
// A 32-bit integer.
using Whole = std::int32_t;
struct CodePair {
  std::int32_t first, second;
};
inline Whole whole_zero() {
  return 0;
}
inline CodePair code_pair(std::int32_t low, std::int32_t high) {
  return {static_cast<std::int16_t>(low), high >> 16};
}
inline Whole add_products(const std::int16_t* p, CodePair codes, Whole sum) {
  return sum + p[0] * codes.first + p[1] * codes.second;
}
inline Float number(Whole a) {
  return static_cast<Float>(a);
}
inline void load_pairs(const std::int16_t* p, Float& first, Float& second) {
  first = p[0];
  second = p[1];
}
// Rounds to the nearest integer, like the vector versions.
inline void store_codes(std::int32_t* low, std::int32_t* high, Float a) {
  const auto code = static_cast<std::uint32_t>(std::lrint(a));
  *low = static_cast<std::int32_t>(code & 0xffff);
  *high = static_cast<std::int32_t>(code << 16);
}
inline void store(float* p, Float a) {
  *p = a;
}
// Returns one bit for each lane.
inline std::uint32_t bits(bool m) {
  return m ? 1 : 0;
}

struct Four {
  float v[4];
  Four() = default;
  explicit Four(float a) : v{a, a, a, a} {}
};
inline Four load_four(const float* p) {
  Four a;
  for (int i = 0; i < 4; ++i) a.v[i] = p[i];
  return a;
}
inline void store(float* p, const Four& a) {
  for (int i = 0; i < 4; ++i) p[i] = a.v[i];
}
inline Four operator+(Four a, const Four& b) {
  for (int i = 0; i < 4; ++i) a.v[i] += b.v[i];
  return a;
}
inline Four operator-(Four a, const Four& b) {
  for (int i = 0; i < 4; ++i) a.v[i] -= b.v[i];
  return a;
}
inline Four operator*(Four a, const Four& b) {
  for (int i = 0; i < 4; ++i) a.v[i] *= b.v[i];
  return a;
}
// Returns four floats whose sum is the sum of all lanes.
inline Four folded(Float a) {
  Four four(0.0f);
  four.v[0] = a;
  return four;
}
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  Four* const rows[4] = {&a, &b, &c, &d};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < i; ++k) {
      const float above = rows[k]->v[i];
      rows[k]->v[i] = rows[i]->v[k];
      rows[i]->v[k] = above;
    }
}

#include "sdk/src/isa/eight_of_fours.inl"

}  // namespace nook::isa_scalar
