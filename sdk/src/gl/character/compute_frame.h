// The data of one update of the compute tier: the records, poses, casters and lights of each chunk's
// instances as one piece of a buffer that is filled from the start each time.
#pragma once

#include <cstdint>

#include "sdk/src/gl/character/compute_scene.h"

namespace nook::gl {

// Two uvec4, as instance.glsl reads them.
struct InstanceRecord {
  std::uint32_t first_bone;                  // element of the chunk's piece of the stream
  std::uint32_t first_sphere;                // in the scene's spheres
  std::uint32_t place;                       // in the chunk, with NOOK_RECORD_SELF
  std::uint32_t light;                       // element of the piece; 0: none
  std::uint32_t first_caster, caster_count;  // element of the piece
  std::uint32_t first_exact, exact_count;
};
static_assert(sizeof(InstanceRecord) == NOOK_RECORD_UVEC4S * 4 * sizeof(std::uint32_t));

// Lays out and writes what is due or has moved; false if that is nothing. Throws Failure if OpenGL gives no
// memory.
bool upload_frame(const Device& device, ComputeScene& placed);

}  // namespace nook::gl
