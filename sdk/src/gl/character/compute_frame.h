// The data of one update of the compute tier: the records, poses and casters of each chunk's instances, in
// one buffer that is filled from the start each time.
#pragma once

#include <cstdint>

#include "sdk/src/gl/character/compute_scene.h"

namespace nook::gl {

// Two uvec4, as instance.glsl reads them.
struct InstanceRecord {
  std::uint32_t first_bone;                  // in the chunk's poses
  std::uint32_t first_sphere;                // in the scene's spheres
  std::uint32_t place;                       // in the chunk
  std::uint32_t light;                       // 1 + its first texel in the lights; 0: none
  std::uint32_t first_caster, caster_count;  // in the chunk's casters, as uvec4
  std::uint32_t first_exact, exact_count;
};
static_assert(sizeof(InstanceRecord) == NOOK_RECORD_UVEC4S * 4 * sizeof(std::uint32_t));

// Lays out and writes what is due or has moved; false if that is nothing. Throws Failure if OpenGL gives no
// memory.
bool upload_frame(const Device& device, ComputeScene& placed);

}  // namespace nook::gl
