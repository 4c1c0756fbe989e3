// Evaluates casters in a pose, and the share of the hemisphere of a point that they leave open.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/world/cone.h"
#include "sdk/src/world/coverage.h"

namespace nook::bake {

// Returns the scale of a matrix that is rigid or scales all axes equally.
inline float scale_of(const Mat3x4& m) {
  return length({m.m[0], m.m[4], m.m[8]});
}

// What a caster is evaluated for.
enum class CasterUse { ao, light };

inline Capsule posed(const WorldCaster& caster, const Pose& pose, CasterUse use) {
  const Mat3x4& m = pose[caster.bone];
  const float scale = scale_of(m) * (use == CasterUse::ao ? caster.ao_scale : 1);
  return {transform_point(m, caster.capsule.a), transform_point(m, caster.capsule.b),
          scale * caster.capsule.radius_a, scale * caster.capsule.radius_b};
}

inline std::vector<Capsule> posed(std::span<const WorldCaster> casters, const Pose& pose, CasterUse use) {
  std::vector<Capsule> capsules;
  for (const WorldCaster& caster : casters) capsules.push_back(posed(caster, pose, use));
  return capsules;
}

inline float coverage_at(const Capsule& c, Vec3 point, Vec3 normal) {
  const Vec3 a = c.a - point, b = c.b - point;
  return world::coverage<float>({a.x, a.y, a.z, b.x, b.y, b.z, c.radius_a, c.radius_b}, normal.x, normal.y,
                                normal.z);
}

// Returns the share of one part of a cone that a capsule hides.
inline float part_coverage_at(const Capsule& c, Vec3 point, Vec3 axis, float slope) {
  const Vec3 a = c.a - point, b = c.b - point;
  return world::part_coverage<float>({a.x, a.y, a.z, b.x, b.y, b.z, c.radius_a, c.radius_b}, axis.x, axis.y,
                                     axis.z, slope);
}

// Returns false if the bounding sphere of the capsule is outside a cone around the axis. Then the capsule
// hides no part of a light inside the cone.
inline bool may_hide(const Capsule& c, Vec3 point, Vec3 axis, float half_angle_radians) {
  const Vec3 centre = 0.5f * (c.a + c.b) - point;
  const float radius = 0.5f * length(c.b - c.a) + std::fmax(c.radius_a, c.radius_b);
  const float depth = dot(centre, axis);
  const float aside = std::sqrt(std::fmax(dot(centre, centre) - depth * depth, 0.0f));
  return half_angle_radians > 1.5f ||
         (depth > -radius &&
          aside * std::cos(half_angle_radians) - depth * std::sin(half_angle_radians) < radius);
}

// Returns the AO of the point: the product of 1 - coverage over all casters.
inline float open_share(std::span<const Capsule> capsules, Vec3 point, Vec3 normal) {
  float open = 1;
  for (const Capsule& capsule : capsules) open *= 1 - coverage_at(capsule, point, normal);
  return open;
}

}  // namespace nook::bake
