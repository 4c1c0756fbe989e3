// Makes stratified, cosine-weighted directions over the hemisphere, for sampling ambient occlusion and
// irradiance.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake {

// Many independent patterns of `rays` directions around +z. Neighbouring vertices and poses use different
// patterns, so that their noise is independent. Directions are cosine-weighted, so visibility is the plain
// mean over a pattern.
class HemispherePatterns {
 public:
  static constexpr std::uint32_t pattern_count = 256;

  // `rays` is split into rows x columns strata of equal probability, as close to a square as the divisors of
  // `rays` allow. Any `rays` >= 1 is valid.
  HemispherePatterns(std::uint32_t rays, std::uint64_t seed);

  std::uint32_t rays() const { return rays_; }
  // Returns rays() unit directions with z >= 0.
  const Vec3* pattern(std::uint32_t index) const {
    return &directions_[std::size_t(index % pattern_count) * rays_];
  }

 private:
  std::uint32_t rays_;
  std::vector<Vec3> directions_;
};

struct Frame {
  Vec3 x, y, z;
};

// Returns an orthonormal basis around a unit normal (Duff et al. 2017), turned by an angle with the given
// cosine and sine.
inline Frame turned_frame(Vec3 n, float cosine, float sine) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  const Vec3 u{1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  const Vec3 v{b, sign + n.y * n.y * a, -n.y};
  return {cosine * u + sine * v, cosine * v - sine * u, n};
}

constexpr Vec3 to_world(const Frame& frame, Vec3 v) {
  return v.x * frame.x + v.y * frame.y + v.z * frame.z;
}

// Returns a direction around +z with the density cos / pi. Uses Malley's method: a uniform point on the disc
// is projected up to the hemisphere. u and v are in [0, 1).
inline Vec3 cosine_direction(float u, float v) {
  const float radius = std::sqrt(u);
  const float angle = 6.2831853f * v;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::fmax(0.0f, 1 - u))};
}

// The finaliser of SplitMix64, which decorrelates consecutive integers.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

constexpr float unit_float(std::uint64_t bits) {
  return float(bits >> 40) * 0x1p-24f;
}

}  // namespace nook::bake
