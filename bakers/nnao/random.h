// Seeded random numbers that are the same on every machine, unlike the standard distributions.
#pragma once

#include <cmath>
#include <cstdint>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake::nnao {

class Random {
 public:
  explicit Random(std::uint64_t seed) : counter_(mix_bits(seed)) {}

  std::uint64_t bits() { return mix_bits(counter_++); }
  float unit() { return unit_float(bits()); }  // in [0, 1)
  float between(float low, float high) { return low + (high - low) * unit(); }
  // Returns a number whose logarithm is uniform; low > 0.
  float log_between(float low, float high) { return low * std::exp(unit() * std::log(high / low)); }
  std::uint32_t below(std::uint32_t count) { return std::uint32_t((bits() >> 32) * count >> 32); }
  // Both ends are included.
  int whole(int low, int high) { return low + int(below(std::uint32_t(high - low + 1))); }
  bool chance(float probability) { return unit() < probability; }

 private:
  std::uint64_t counter_;
};

}  // namespace nook::bake::nnao
