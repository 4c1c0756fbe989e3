#include "bakers/character/pose_prior.h"

#include <cstdint>
#include <utility>

namespace nook::bake {
namespace {

#include "bakers/character/pose_prior_table.inl"

constexpr std::uint32_t total() {
  std::uint32_t sum = 0;
  for (const std::uint16_t s : share) sum += s;
  return sum;
}
constexpr std::uint32_t share_total = total();
constexpr float table_unit = 0.01f;

Vec3 vector_at(const float* value) {
  return {value[0], value[1], value[2]};
}

PriorLimbs limbs_at(const float* value) {
  return {normalised(vector_at(value)),      normalised(vector_at(value + 3)),
          normalised(vector_at(value + 6)),  normalised(vector_at(value + 9)),
          normalised(vector_at(value + 12)), normalised(vector_at(value + 15))};
}

// A reflection turns the sense of turns about.
Vec3 mirrored_turn(Vec3 turn) {
  return {turn.x, -turn.y, -turn.z};
}
Vec3 mirrored_direction(Vec3 direction) {
  return {-direction.x, direction.y, direction.z};
}
PriorLimbs mirrored_limbs(const PriorLimbs& l) {
  return {mirrored_direction(l.upper_arm), mirrored_direction(l.forearm), mirrored_direction(l.hand),
          mirrored_direction(l.thigh),     mirrored_direction(l.calf),    mirrored_direction(l.foot)};
}

}  // namespace

PriorPose prior_pose(Random& random) {
  std::uint32_t at = random.below(share_total);
  std::size_t chosen = 0;
  while (at >= share[chosen]) at -= share[chosen++];
  const std::int16_t* middle = centre[chosen];
  float value[value_count];
  for (int i = 0; i < value_count; ++i) value[i] = table_unit * float(middle[i]);
  for (const auto& spread : factor) {
    const float amount = table_unit * random.normal();
    for (int i = 0; i < value_count; ++i) value[i] += amount * float(spread[i]);
  }
  PriorPose pose{vector_at(value), vector_at(value + 3), {limbs_at(value + 6), limbs_at(value + 24)}};
  if (random.chance(0.5f)) {
    pose.chest = mirrored_turn(pose.chest);
    pose.head = mirrored_turn(pose.head);
    std::swap(pose.limbs[0], pose.limbs[1]);
    for (PriorLimbs& l : pose.limbs) l = mirrored_limbs(l);
  }
  return pose;
}

}  // namespace nook::bake
