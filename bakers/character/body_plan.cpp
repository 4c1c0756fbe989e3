#include "bakers/character/body_plan.h"

#include <algorithm>
#include <cmath>
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

// A reflection reverses the direction of turns.
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

Vec3 normal3(PoseRandom& random) {
  const float x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

void plan_arm(LimbPlan& plan, PoseRandom& random) {
  // The elevation is measured from straight down, the azimuth from the front.
  const float kind = random.unit();
  float elevation, azimuth;
  if (kind < 0.45f) {
    elevation = std::fabs(12 + 18 * random.normal()) * degree;
    azimuth = random.between(-60, 150) * degree;
    plan.elbow =
        std::fabs(random.chance(0.5f) ? 15 + 15 * random.normal() : 60 + 40 * random.normal()) * degree;
  } else if (kind < 0.85f) {
    elevation = (60 + 25 * random.normal()) * degree;
    azimuth = (15 + 35 * random.normal()) * degree;
    plan.elbow = std::fabs(60 + 45 * random.normal()) * degree;
  } else {
    elevation = random.between(60, 165) * degree;
    azimuth = random.between(10, 110) * degree;
    plan.elbow = std::fabs(45 + 45 * random.normal()) * degree;
  }
  plan.elbow = std::min(plan.elbow, 145 * degree);
  plan.arm_direction = {std::sin(elevation) * std::sin(azimuth), -std::cos(elevation),
                        std::sin(elevation) * std::cos(azimuth)};
  plan.arm_twist = 25 * degree * random.normal();
  plan.elbow_lean = 0.5f * normal3(random);
}

namespace {

LimbPlan plan_limbs(PoseRandom& random) {
  LimbPlan plan;
  plan_arm(plan, random);
  // Legs stand, stride, crouch or sit, or kick backwards.
  const float stance = random.unit();
  if (stance < 0.35f) {
    plan.hip_flexion = 10 * degree * random.normal();
    plan.knee = std::fabs(10 * random.normal()) * degree;
  } else if (stance < 0.65f) {
    plan.hip_flexion = (10 + 28 * random.normal()) * degree;
    plan.knee = std::fabs(30 + 28 * random.normal()) * degree;
  } else if (stance < 0.95f) {
    plan.hip_flexion = (80 + 22 * random.normal()) * degree;
    plan.knee = std::fabs(90 + 28 * random.normal()) * degree;
  } else {
    plan.hip_flexion = random.between(-40, 0) * degree;
    plan.knee = random.between(20, 120) * degree;
  }
  plan.hip_flexion = std::clamp(plan.hip_flexion, -45 * degree, 130 * degree);
  plan.knee = std::clamp(plan.knee, 0.0f, 145 * degree);
  plan.hip_abduction = (6 + 12 * random.normal()) * degree;
  plan.hip_twist = 12 * degree * random.normal();
  plan.ankle = 15 * degree * random.normal();
  plan.toe = random.chance(0.3f) ? random.between(0, 40) * degree : 0;
  // Fingers are stretched, relaxed or closed to a fist.
  const float grip = random.unit();
  plan.curl = grip < 0.25f   ? 0.08f * random.normal()
              : grip < 0.65f ? 0.35f + 0.15f * random.normal()
                             : 0.85f + 0.15f * random.normal();
  plan.thumb = random.unit();
  plan.clavicle = (12 * degree) * normal3(random);
  plan.hand = (30 * degree) * normal3(random);
  return plan;
}

}  // namespace

BodyPlan plan_body(PoseRandom& random) {
  BodyPlan plan;
  plan.limb[0] = plan_limbs(random);
  plan.limb[1] = plan_limbs(random);
  // People often move both sides in the same way. Then the sides differ only a little.
  if (random.chance(0.4f)) {
    LimbPlan& l = plan.limb[1];
    l = plan.limb[0];
    l.arm_direction = normalised(l.arm_direction + 0.15f * normal3(random));
    l.elbow = std::fabs(l.elbow + 10 * degree * random.normal());
    l.hip_flexion += 8 * degree * random.normal();
    l.knee = std::fabs(l.knee + 8 * degree * random.normal());
    l.curl += 0.1f * random.normal();
  } else if (random.chance(0.4f)) {
    plan.limb[1].hip_flexion = plan.limb[0].hip_flexion + 10 * degree * random.normal();
    plan.limb[1].knee = std::fabs(plan.limb[0].knee + 10 * degree * random.normal());
  }
  // Both hands are in front of the body, as for holding, aiming, praying or resting in the lap.
  if (random.chance(0.15f)) {
    LimbPlan& l = plan.limb[0];
    const float elevation = random.between(5, 115) * degree;
    const float azimuth = (-15 + 20 * random.normal()) * degree;
    l.arm_direction = {std::sin(elevation) * std::sin(azimuth), -std::cos(elevation),
                       std::sin(elevation) * std::cos(azimuth)};
    l.elbow = random.between(5, 110) * degree;
    l.elbow_lean = Vec3{-0.5f, 0, 0} + 0.3f * normal3(random);
    LimbPlan& r = plan.limb[1];
    r.arm_direction = normalised(l.arm_direction + 0.15f * normal3(random));
    r.elbow = std::fabs(l.elbow + 20 * degree * random.normal());
    r.elbow_lean = {l.elbow_lean.x, l.elbow_lean.y, l.elbow_lean.z};
  }
  const float crouch = std::max(0.0f, std::min(plan.limb[0].hip_flexion, plan.limb[1].hip_flexion));
  plan.bend = (8 + 22 * random.normal()) * degree + 0.25f * crouch * random.unit();
  // A spine bends backwards by about 30 degrees and forwards by three times as much.
  plan.bend = std::clamp(plan.bend, -30 * degree, 90 * degree);
  plan.lean = 12 * degree * random.normal();
  plan.twist = 20 * degree * random.normal();
  plan.neck = {28 * degree * random.normal(), 32 * degree * random.normal(), 14 * degree * random.normal()};
  // If the trunk is bent, the head is raised to look ahead.
  plan.neck.x -= 0.7f * std::max(0.0f, plan.bend) * random.unit();
  return plan;
}

}  // namespace nook::bake
