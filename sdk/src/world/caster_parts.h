// Splits a body into parts, such as limbs, and merges the casters of a part or body into one capsule, which
// stands for them at a distance.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/geometry.h"
#include "shaders/world/constants.h"

namespace nook::world {

inline constexpr std::uint32_t max_part_casters = 64, max_parts = NOOK_MAX_PARTS;

// Casters that stand near each other in rest space. Part p has the casters order[first[p]] to
// order[first[p + 1] - 1].
struct CasterParts {
  std::uint32_t count = 0;
  std::array<std::uint8_t, max_parts + 1> first{};
  std::array<std::uint8_t, max_part_casters> order{};
};

// Makes parts with five casters on average. middle: centres of at most max_part_casters casters. The parts'
// first casters are as far from each other as possible (Gonzalez 1985).
CasterParts parts_of(std::span<const Vec3> middle);

// Returns one capsule, with its radii for AO, for the casters that `order` picks. It has their mean projected
// area, their centre and their longest axis.
Capsule merged(std::span<const PosedCaster> casters, std::span<const std::uint8_t> order);

// Returns the distance in metres from its centre at which the merged capsule may stand for its casters.
// There, the rms difference over directions and normals is about error_ao. strength: the casters'
// caster_strength. radius: of a sphere around them.
float merging_distance(float strength, float radius, float error_ao);

}  // namespace nook::world
