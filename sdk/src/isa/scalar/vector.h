// One float at a time: the reference of the other instruction sets, and what processors without one of them
// run.
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
inline void store(float* p, Float a) {
  *p = a;
}

}  // namespace nook::isa_scalar
