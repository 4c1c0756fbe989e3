// Seeded random numbers. They are the same on every machine, unlike those from the standard distributions.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake {

// Makes 64 random bits by mixing the bits of a counter.
class MixedCounter {
 public:
  explicit MixedCounter(std::uint64_t seed) : counter_(mix_bits(seed)) {}
  std::uint64_t operator()() { return mix_bits(counter_++); }

 private:
  std::uint64_t counter_;
};

// A stream of random numbers that depends only on the seed. The generator gives 64 random bits at a time.
template <class Generator>
class RandomFrom {
 public:
  explicit RandomFrom(std::uint64_t seed) : generator_(seed) {}

  std::uint64_t bits() { return generator_(); }
  float unit() { return unit_float(bits()); }                      // in [0, 1)
  double unit_double() { return double(bits() >> 11) * 0x1p-53; }  // in [0, 1)
  float between(float low, float high) { return low + (high - low) * unit(); }
  // Returns a number whose logarithm is uniform; low > 0.
  float log_between(float low, float high) { return low * std::exp(unit() * std::log(high / low)); }
  std::uint32_t below(std::uint32_t count) { return std::uint32_t((bits() >> 32) * count >> 32); }
  // Returns a uniform integer from `low` to `high`, both included.
  int whole(int low, int high) { return low + int(below(std::uint32_t(high - low + 1))); }
  bool chance(float probability) { return unit() < probability; }
  // Returns a number of the standard normal distribution (Box and Muller 1958).
  float normal() {
    const float r = std::sqrt(-2 * std::log(unit() + 1e-12f));
    return r * std::cos(2 * std::numbers::pi_v<float> * unit());
  }

 private:
  Generator generator_;
};

using Random = RandomFrom<MixedCounter>;

}  // namespace nook::bake
