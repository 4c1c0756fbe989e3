#include "sdk/src/world/caster_parts.h"

#include <algorithm>
#include <cmath>

namespace nook::world {
namespace {

constexpr float pi = 3.14159265f;
constexpr std::uint32_t casters_of_part = 5;

float squared(Vec3 a) {
  return dot(a, a);
}

// Returns the projected area of a capsule, averaged over all directions. For a convex body, this is a quarter
// of its surface area (Cauchy).
float projected_area(float radius, float length) {
  return pi * radius * (0.5f * length + radius);
}

// A symmetric matrix, stored by rows.
struct Spread {
  Vec3 x, y, z;
  Vec3 times(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  void add(float weight, Vec3 v) {
    x += weight * v.x * v;
    y += weight * v.y * v;
    z += weight * v.z * v;
  }
  float trace() const { return x.x + y.y + z.z; }
};

}  // namespace

CasterParts parts_of(std::span<const Vec3> middle) {
  CasterParts parts;
  const auto n = static_cast<std::uint32_t>(std::min<std::size_t>(middle.size(), max_part_casters));
  if (n == 0) return parts;
  parts.count = std::min((n + casters_of_part - 1) / casters_of_part, max_parts);
  std::array<std::uint8_t, max_part_casters> part{};
  std::array<float, max_part_casters> distance2{};
  std::uint32_t seed = 0;
  for (std::uint32_t p = 0; p < parts.count; ++p) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const float d2 = squared(middle[i] - middle[seed]);
      if (p > 0 && !(d2 < distance2[i])) continue;
      distance2[i] = d2;
      part[i] = static_cast<std::uint8_t>(p);
    }
    seed = static_cast<std::uint32_t>(std::max_element(distance2.begin(), distance2.begin() + n) -
                                      distance2.begin());
  }
  std::uint8_t next = 0;
  for (std::uint32_t p = 0; p < parts.count; ++p) {
    parts.first[p] = next;
    for (std::uint32_t i = 0; i < n; ++i)
      if (part[i] == p) parts.order[next++] = static_cast<std::uint8_t>(i);
  }
  parts.first[parts.count] = next;
  return parts;
}

Capsule merged(std::span<const PosedCaster> casters, std::span<const std::uint8_t> order) {
  float area = 0;
  Vec3 sum;
  const auto radius_of = [&](const PosedCaster& c) {
    return 0.5f * c.ao_scale * (c.capsule.radius_a + c.capsule.radius_b);
  };
  for (const std::uint8_t i : order) {
    const PosedCaster& c = casters[i];
    const float own = projected_area(radius_of(c), length(c.capsule.b - c.capsule.a));
    area += own;
    sum += 0.5f * own * (c.capsule.a + c.capsule.b);
  }
  if (!(area > 0)) return {};
  const Vec3 centre = sum * (1 / area);
  Spread spread;
  Vec3 axis{0.37f, 0.74f, 0.56f};
  float longest2 = 0;
  for (const std::uint8_t i : order) {
    const PosedCaster& c = casters[i];
    const Vec3 along = c.capsule.b - c.capsule.a, off = 0.5f * (c.capsule.a + c.capsule.b) - centre;
    const float own = projected_area(radius_of(c), length(along)) / area;
    spread.add(own, off);
    spread.add(own / 12, along);
    for (const Vec3 v : {along, 2.0f * off})
      if (squared(v) > longest2) {
        longest2 = squared(v);
        axis = v;
      }
  }
  // Finds the longest axis with the power method. The start vector is the longest of these vectors: the axis
  // of each caster, and twice the offset of each caster from the centre.
  axis = normalised(axis);
  for (int step = 0; step < 6; ++step) {
    const Vec3 next = spread.times(axis);
    if (!(squared(next) > 1e-20f)) break;
    axis = normalised(next);
  }
  // The length of the segment follows from its variance, which is the variance along the axis minus the
  // variance across it.
  const float along2 = dot(axis, spread.times(axis)), across2 = 0.5f * (spread.trace() - along2);
  // For a bent part, this segment is longer than the part itself. The capsule could then reach through the
  // surface on which the casters stand. So the segment is shortened until the capsule ends where the casters
  // end. The centre of the capsule does not change.
  float reach_below = 0, reach_above = 0;
  for (const std::uint8_t i : order) {
    const PosedCaster& c = casters[i];
    const float a = dot(axis, c.capsule.a - centre), b = dot(axis, c.capsule.b - centre);
    const float ra = c.ao_scale * c.capsule.radius_a, rb = c.ao_scale * c.capsule.radius_b;
    reach_below = std::max({reach_below, ra - a, rb - b});
    reach_above = std::max({reach_above, ra + a, rb + b});
  }
  const float reach = std::min(reach_below, reach_above);
  const auto radius_of_length = [area](float length) {
    return 0.5f * (std::sqrt(0.25f * length * length + 4 * area / pi) - 0.5f * length);
  };
  float extent = std::sqrt(12 * std::max(along2 - across2, 0.0f));
  // A shorter segment needs a larger radius for the same projected area, and with a larger radius, the
  // segment must be shortened again. So a few iterations are needed.
  for (int step = 0; step < 3; ++step)
    extent = std::min(extent, 2 * std::max(reach - radius_of_length(extent), 0.0f));
  const float radius = radius_of_length(extent);
  const Vec3 half = 0.5f * extent * axis;
  return {centre - half, centre + half, radius, radius};
}

float merging_distance(float strength, float radius, float error_ao) {
  if (!(error_ao > 0)) return 1e15f;
  // The difference in AO decreases with the fourth power of the distance. The factor 0.1 was measured on
  // bodies, by the test of this file.
  const float far = std::sqrt(std::sqrt(0.1f * strength * radius * radius / error_ao));
  return std::max(far, 1.2f * radius);
}

}  // namespace nook::world
