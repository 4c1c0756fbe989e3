#include "sdk/src/character/sphere_groups.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nook {
namespace {

// The spheres order[begin] up to but not including order[end], with their centre and their second moments
// along the axes.
struct Group {
  std::uint32_t begin = 0, end = 0;
  Vec3 centre, moment;
  float total() const { return moment.x + moment.y + moment.z; }
};

// A sphere has at least this mass, so that groups of spheres with weight 0 can be split too.
constexpr float least_mass = 1e-12f;
constexpr float least_squared_distance = 1e-6f;  // for a body of scale 1; keeps quotients finite

float mass_of(const ProxySphere& sphere) {
  return std::max(sphere.caster_weight * sphere.radius * sphere.radius, least_mass);
}

Group measured(const CharacterModel& model, const Vector<std::uint32_t>& order, std::uint32_t begin,
               std::uint32_t end) {
  Group group{begin, end, {}, {}};
  float mass = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    const ProxySphere& sphere = model.spheres[order[i]];
    group.centre += sphere.centre * mass_of(sphere);
    mass += mass_of(sphere);
  }
  group.centre = group.centre * (1 / mass);
  for (std::uint32_t i = begin; i < end; ++i) {
    const ProxySphere& sphere = model.spheres[order[i]];
    const Vec3 d = sphere.centre - group.centre;
    group.moment += Vec3{d.x * d.x, d.y * d.y, d.z * d.z} * mass_of(sphere);
  }
  return group;
}

float along_longest(const Group& group, Vec3 p) {
  const Vec3& m = group.moment;
  return m.x >= m.y && m.x >= m.z ? p.x : m.y >= m.z ? p.y : p.z;
}

// Splits a group into two. Each half gets at least one sphere.
std::array<Group, 2> split(const CharacterModel& model, Vector<std::uint32_t>& order, const Group& group) {
  const auto from = order.begin() + group.begin, to = order.begin() + group.end;
  const float middle = along_longest(group, group.centre);
  const auto before = [&](std::uint32_t s) { return along_longest(group, model.spheres[s].centre) < middle; };
  auto cut = std::stable_partition(from, to, before);
  // If all places are equal, rounding can put every sphere on one side.
  if (cut == from || cut == to) cut = from + (to - from) / 2;
  const auto at = static_cast<std::uint32_t>(cut - order.begin());
  return {measured(model, order, group.begin, at), measured(model, order, at, group.end)};
}

}  // namespace

SphereGroups::SphereGroups(const CharacterModel& model, Memory* memory) {
  const auto count = static_cast<std::uint32_t>(model.spheres.size());
  if (count == 0) return;
  Vector<std::uint32_t> order(count, 0u, memory);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  Vector<Group> groups(memory);
  groups.push_back(measured(model, order, 0, count));
  // Goes from the coarsest tier to the finest. Wherever a coarse group begins, a group of each finer tier
  // begins too.
  std::array<Vector<std::uint32_t>, group_tiers> begins{
      Vector<std::uint32_t>(memory), Vector<std::uint32_t>(memory), Vector<std::uint32_t>(memory)};
  for (std::uint32_t t = group_tiers; t-- > 0;) {
    while (groups.size() < std::min(tier_groups[t], count)) {
      auto largest = groups.end();
      for (auto g = groups.begin(); g != groups.end(); ++g)
        if (g->end - g->begin > 1 && (largest == groups.end() || g->total() > largest->total())) largest = g;
      const std::array<Group, 2> halves = split(model, order, *largest);
      *largest = halves[0];
      groups.insert(largest + 1, halves[1]);
    }
    for (const Group& group : groups) begins[t].push_back(group.begin);
  }
  for (std::uint32_t t = 0; t < group_tiers; ++t) {
    Tier& tier = tiers_[t];
    tier.first = AlignedArray<std::uint32_t>(begins[t].size() + 1, memory);
    const std::size_t parts = t == 0 ? count : begins[t - 1].size();
    tier.member = AlignedArray<std::uint32_t>(parts, memory);
    for (std::size_t i = 0; i < parts; ++i)
      tier.member[i] = t == 0 ? order[i] : static_cast<std::uint32_t>(i);
    for (std::size_t g = 0; g < begins[t].size(); ++g)
      tier.first[g] = t == 0
                          ? begins[t][g]
                          : static_cast<std::uint32_t>(
                                std::lower_bound(begins[t - 1].begin(), begins[t - 1].end(), begins[t][g]) -
                                begins[t - 1].begin());
    tier.first[begins[t].size()] = static_cast<std::uint32_t>(parts);
  }
}

Receiver receiver_of(const float* x, const float* y, const float* z, std::uint32_t count, float scale) {
  Receiver out;
  out.scale = scale;
  for (std::uint32_t k = 0; k < count; ++k) {
    out.min = {std::min(out.min.x, x[k]), std::min(out.min.y, y[k]), std::min(out.min.z, z[k])};
    out.max = {std::max(out.max.x, x[k]), std::max(out.max.y, y[k]), std::max(out.max.z, z[k])};
  }
  for (std::uint32_t s = 0; count > 0 && s < Receiver::samples; ++s) {
    const std::uint32_t k = (2 * s + 1) * count / (2 * Receiver::samples);
    out.x[s] = x[k];
    out.y[s] = y[k];
    out.z[s] = z[k];
  }
  return out;
}

namespace {

float nearest_group_error(const GroupLanes& groups, const Receiver& receiver) {
  const auto outside = [](float place, float min, float max) {
    return std::max({min - place, place - max, 0.0f});
  };
  float sum = 0;
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    if (!(groups.moment[g] > 0)) continue;  // a single sphere
    const float x = outside(groups.x[g], receiver.min.x, receiver.max.x),
                y = outside(groups.y[g], receiver.min.y, receiver.max.y),
                z = outside(groups.z[g], receiver.min.z, receiver.max.z);
    const float squared = x * x + y * y + z * z;
    sum += groups.moment[g] / (squared * squared);
  }
  return 1.2f * sum;
}

}  // namespace

float group_error(const GroupLanes& groups, const Receiver& receiver) {
  std::array<float, Receiver::samples> at{};
  const float least = least_squared_distance * receiver.scale * receiver.scale;
  for (std::uint32_t g = 0; g < groups.count; ++g)
    for (std::uint32_t s = 0; s < Receiver::samples; ++s) {
      const float x = groups.x[g] - receiver.x[s], y = groups.y[g] - receiver.y[s],
                  z = groups.z[g] - receiver.z[s];
      const float squared = x * x + y * y + z * z + least;
      at[s] += groups.moment[g] / (squared * squared);
    }
  float squares = 0;
  for (const float sum : at) squares += sum * sum;
  return std::max(1.2f * std::sqrt(squares / Receiver::samples), nearest_group_error(groups, receiver) / 16);
}

void merge_groups(const SphereGroups::Tier& tier, const SphereSoa& parts, const float* part_moments,
                  const GroupLanes& out) {
  for (std::uint32_t g = 0; g < out.count; ++g) {
    const std::uint32_t *const begin = tier.member.data() + tier.first[g], *const end = tier.member.data() +
                                                                                        tier.first[g + 1];
    // If all parts have mass 0, the group gets the position of its first part.
    float mass = 0, x = parts.x[*begin], y = parts.y[*begin], z = parts.z[*begin], own = 0;
    float sum_x = 0, sum_y = 0, sum_z = 0;
    for (const std::uint32_t* i = begin; i < end; ++i) {
      const float squared = 1 / (parts.inverse_radius[*i] * parts.inverse_radius[*i]);
      const float m = parts.caster_weight[*i] * squared;
      mass += m;
      own += m * squared;
      sum_x += m * (parts.x[*i] - x);
      sum_y += m * (parts.y[*i] - y);
      sum_z += m * (parts.z[*i] - z);
    }
    const float inverse = mass > 0 ? 1 / mass : 0;
    x += sum_x * inverse;
    y += sum_y * inverse;
    z += sum_z * inverse;
    float moment = 0;
    for (const std::uint32_t* i = begin; i < end; ++i) {
      const float dx = parts.x[*i] - x, dy = parts.y[*i] - y, dz = parts.z[*i] - z;
      const float m = parts.caster_weight[*i] / (parts.inverse_radius[*i] * parts.inverse_radius[*i]);
      moment += m * (dx * dx + dy * dy + dz * dz);
    }
    // The squared radius of a group is the mean squared radius of its parts, plus a term for the spread of
    // their centres.
    const float squared = (own + (4.0f / 3) * moment) * inverse;
    out.x[g] = x;
    out.y[g] = y;
    out.z[g] = z;
    out.inverse_radius[g] =
        squared > min_sphere_radius * min_sphere_radius ? 1 / std::sqrt(squared) : 1 / min_sphere_radius;
    out.caster_weight[g] = mass * out.inverse_radius[g] * out.inverse_radius[g];
    for (const std::uint32_t* i = begin; part_moments && i < end; ++i) moment += part_moments[*i];
    out.moment[g] = moment;
  }
}

}  // namespace nook
