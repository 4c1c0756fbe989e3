#include "sdk/src/gl/world/caster_texels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/character/scene.h"
#include "shaders/world/constants.h"

namespace nook::gl {
namespace {

constexpr std::array<std::uint8_t, world::max_part_casters> every_caster = [] {
  std::array<std::uint8_t, world::max_part_casters> order{};
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint8_t>(i);
  return order;
}();

// The parts of a prop or occluder: a single part with one caster.
constexpr world::CasterParts one_caster{1, {0, 1}, {}};

// A bounding sphere of the casters that `order` selects, and their total strength; see caster_strength.
struct Bound {
  Vec3 centre;
  float radius = 0, strength = 0;
};

Bound bound_of(std::span<const PosedCaster> casters, std::span<const std::uint8_t> order) {
  Bound bound;
  Vec3 sum;
  for (const std::uint8_t i : order) sum += casters[i].capsule.a + casters[i].capsule.b;
  bound.centre = sum * (0.5f / static_cast<float>(order.size()));
  for (const std::uint8_t i : order) {
    const Capsule& c = casters[i].capsule;
    const float radius = casters[i].ao_scale * std::max(c.radius_a, c.radius_b);
    bound.radius =
        std::max({bound.radius, length(c.a - bound.centre) + radius, length(c.b - bound.centre) + radius});
    bound.strength += caster_strength(casters[i]);
  }
  return bound;
}

// Packs the strength and the radius of a group into one float for casters.glsl. Both are rounded up.
float packed_bound(const ReachingGroup& group) {
  const float strength = group.strength_over_cutoff;
  if (!(strength < NOOK_LARGEST_STRENGTH && group.radius < 0.99f * NOOK_LARGEST_RADIUS))
    return NOOK_ENDLESS_BOUND;
  // The integer part has up to 32,768 steps, which leaves eight bits of the float for the fraction. Adding
  // 0.005 ensures that rounding the fraction never makes it too small.
  return std::ceil(strength * NOOK_STRENGTH_STEPS) + 0.005f + group.radius / NOOK_LARGEST_RADIUS;
}

float squared(float a) {
  return a * a;
}

}  // namespace

Vec3 viewed(const float* m, Vec3 p) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

Vec3 turned(const float* m, Vec3 d) {
  return {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
          m[2] * d.x + m[6] * d.y + m[10] * d.z};
}

std::uint64_t texels_of(const ReachingGroup& group) {
  const std::uint64_t parts = group.parts ? group.parts->count : 1;
  return NOOK_BODY_TEXELS + parts * NOOK_PART_TEXELS + group.casters.size() * NOOK_CASTER_TEXELS;
}

std::uint64_t shade_texels_of(const ReachingGroup& group) {
  return NOOK_SHADE_TEXELS + group.casters.size() * NOOK_CASTER_TEXELS;
}

CasterTexels::CasterTexels(float* table, const float* view, std::uint32_t bodies)
    : table_(table), view_(view), next_(std::uint64_t{bodies} * NOOK_BODY_TEXELS) {}

void CasterTexels::put(std::uint64_t texel, float x, float y, float z, float w) {
  float* const at = table_ + 4 * texel;
  at[0] = x;
  at[1] = y;
  at[2] = z;
  at[3] = w;
}

void CasterTexels::put_place(std::uint64_t texel, Vec3 place, float w) {
  const Vec3 p = viewed(view_, place);
  put(texel, p.x, p.y, p.z, w);
}

void CasterTexels::put_capsule(std::uint64_t texel, const Capsule& capsule, float scale) {
  put_place(texel, capsule.a, scale * capsule.radius_a);
  put_place(texel + 1, capsule.b, scale * capsule.radius_b);
}

void CasterTexels::put(std::uint32_t body, const ReachingGroup& group, float level_error) {
  const std::uint64_t texel = std::uint64_t{body} * NOOK_BODY_TEXELS;
  put_place(texel, group.centre, packed_bound(group));
  const world::CasterParts& parts = group.parts ? *group.parts : one_caster;
  put(texel + 1, float(next_), float(parts.count), squared(group.merging_distance(level_error)), 0);
  if (!group.parts) level_error = 0;
  put_capsule(texel + 2, world::merged(group.casters, {every_caster.data(), group.casters.size()}), 1);
  put_parts(group, parts, level_error);
}

void CasterTexels::begin_shades(std::uint64_t first, std::uint32_t bodies) {
  shades_ = first;
  next_ = first + std::uint64_t{bodies} * NOOK_SHADE_TEXELS;
}

void CasterTexels::put_shade(std::uint32_t body, const ReachingGroup& group) {
  const std::uint64_t texel = shades_ + std::uint64_t{body} * NOOK_SHADE_TEXELS;
  put_place(texel, group.centre, group.radius);
  put(texel + 1, float(next_), float(group.casters.size()), 0, 0);
  for (const PosedCaster& caster : group.casters) {
    put_capsule(next_, caster.capsule, 1);
    next_ += NOOK_CASTER_TEXELS;
  }
}

void CasterTexels::put_parts(const ReachingGroup& group, const world::CasterParts& parts, float level_error) {
  std::uint64_t part = next_, caster = next_ + std::uint64_t{parts.count} * NOOK_PART_TEXELS;
  for (std::uint32_t p = 0; p < parts.count; ++p, part += NOOK_PART_TEXELS) {
    const std::span<const std::uint8_t> order{parts.order.data() + parts.first[p],
                                              std::size_t(parts.first[p + 1] - parts.first[p])};
    const Bound bound = bound_of(group.casters, order);
    put_place(part, bound.centre,
              squared(world::merging_distance(bound.strength, bound.radius, level_error)));
    put(part + 1, float(caster), float(order.size()), 0, 0);
    put_capsule(part + 2, world::merged(group.casters, order), 1);
    for (const std::uint8_t i : order) {
      put_capsule(caster, group.casters[i].capsule, group.casters[i].ao_scale);
      caster += NOOK_CASTER_TEXELS;
    }
  }
  next_ = caster;
}

}  // namespace nook::gl
