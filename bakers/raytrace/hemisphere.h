// Stratified cosine-weighted directions over the hemisphere: the samples of every ray-traced ambient occlusion.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace nook::bake {

// Many independent patterns of `rays` directions each, round +z, so that neighbouring vertices and poses do not share noise.
// Directions are cosine-weighted, so that visibility is their plain mean (design: ground truth of character AO).
class HemispherePatterns {
 public:
  static constexpr std::uint32_t pattern_count = 256;

  // rays is split into rows x columns strata of equal probability, as near to a square as its divisors allow; any
  // rays >= 1 is fine.
  HemispherePatterns(std::uint32_t rays, std::uint64_t seed);

  std::uint32_t rays() const { return rays_; }
  // rays() unit directions, z >= 0.
  const Vec3* pattern(std::uint32_t index) const { return &directions_[std::size_t(index % pattern_count) * rays_]; }

 private:
  std::uint32_t rays_;
  std::vector<Vec3> directions_;
};

// SplitMix64's finaliser: decorrelates consecutive integers.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Uniform in [0, 1) from the upper bits.
constexpr float unit_float(std::uint64_t bits) { return float(bits >> 40) * 0x1p-24f; }

}  // namespace nook::bake
