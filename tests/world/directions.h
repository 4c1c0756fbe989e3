// Capsules and directions for tests of what casters cover, by means that share nothing with the formulas.
#pragma once

#include <cmath>
#include <numbers>

#include "sdk/src/core/geometry.h"
#include "sdk/src/world/coverage.h"

namespace nook::test {

// Returns whether a ray from the origin meets the capsule, by 600 spheres along it. They are so dense that
// the silhouette is wrong by less than 1e-4 of a radius for the capsules of these tests.
inline bool meets(Vec3 direction, const Capsule& c) {
  constexpr int steps = 600;
  for (int i = 0; i <= steps; ++i) {
    const float t = float(i) / steps;
    const Vec3 centre = c.a + t * (c.b - c.a);
    const float radius = c.radius_a + t * (c.radius_b - c.radius_a);
    const float along = dot(centre, direction);
    if (dot(centre, centre) <= radius * radius) return true;
    if (along > 0 && dot(centre, centre) - along * along < radius * radius) return true;
  }
  return false;
}

// The share of the cosine-weighted hemisphere about +z that a capsule covers, by a spiral of directions. Its
// error falls with nearly the inverse of their number: 1e-3 for the capsules of these tests.
inline double traced_coverage(const Capsule& c, int directions = 4000) {
  int hits = 0;
  for (int i = 0; i < directions; ++i) {
    const double square = (i + 0.5) / directions, angle = 2.399963229728653 * i;
    const double radius = std::sqrt(square);
    hits += meets(
        {float(radius * std::cos(angle)), float(radius * std::sin(angle)), float(std::sqrt(1 - square))}, c);
  }
  return double(hits) / directions;
}

inline world::CapsuleLanes<float> lanes_of(const Capsule& c) {
  return {c.a.x, c.a.y, c.a.z, c.b.x, c.b.y, c.b.z, c.radius_a, c.radius_b};
}

// The coverage of the origin with the normal +z.
inline float coverage_of(const Capsule& c) {
  return world::coverage<float>(lanes_of(c), 0, 0, 1);
}

}  // namespace nook::test
