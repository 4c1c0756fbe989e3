// Splits a body into parts, such as limbs. Also merges the casters of a part or of a whole body into one
// capsule, which replaces them for distant receivers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/geometry.h"
#include "shaders/world/constants.h"

namespace nook::world {

inline constexpr std::uint32_t max_part_casters = 64, max_parts = NOOK_MAX_PARTS;

// The parts of a body. The casters of a part are near each other in rest space. Part p consists of the
// casters order[first[p]] to order[first[p + 1] - 1].
struct CasterParts {
  std::uint32_t count = 0;
  std::array<std::uint8_t, max_parts + 1> first{};
  std::array<std::uint8_t, max_part_casters> order{};
};

// Makes parts of five casters on average. `middle` holds the centres of the casters. There may be at most
// max_part_casters. The first casters of the parts are chosen as far from each other as possible (Gonzalez
// 1985).
CasterParts parts_of(std::span<const Vec3> middle);

// Returns one capsule, with radii for AO, that replaces the casters with the indices in `order`. The capsule
// has the same mean projected area, the same centre and the same longest axis as these casters together.
Capsule merged(std::span<const PosedCaster> casters, std::span<const std::uint8_t> order);

// Returns a distance from the centre of the merged capsule, in metres. Beyond this distance, the capsule may
// replace its casters. At this distance, the RMS difference in AO over directions and normals is about
// error_ao. `strength` is the sum of the casters' caster_strength. `radius` is the radius of a sphere around
// the casters.
float merging_distance(float strength, float radius, float error_ao);

}  // namespace nook::world
