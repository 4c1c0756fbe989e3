// Parts of a body, such as a limb, and the one capsule that stands for the casters of a part or of a body
// where they are far away.
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

// Five casters a part in the mean. middle: of the casters, at most max_part_casters. The parts' first casters
// are as far from each other as they can be (Gonzalez 1985).
CasterParts parts_of(std::span<const Vec3> middle);

// The capsule, with its radii in AO, that has the mean projected area, the centre and the longest axis of the
// casters that `order` picks.
Capsule merged(std::span<const PosedCaster> casters, std::span<const std::uint8_t> order);

// Where the merged capsule begins to stand for its casters: so many metres from its centre the rms of the
// difference, over directions and normals, is about error_ao. strength: of the casters, see
// caster_strength. radius: of a sphere round them.
float merging_distance(float strength, float radius, float error_ao);

}  // namespace nook::world
