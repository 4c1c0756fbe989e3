// Declares where the compute passes find an instance's data. Positions are relative to the instance's origin,
// so that a scene far from the world's origin keeps its precision.
#include "shaders/character/constants.h"
#include "shaders/character/layout.h"

// What the CPU sends for an update of the chunk: records, bones, casters and lights, with floats as bits.
// Element numbers in a record are indices into the stream.
layout(std430, binding = NOOK_BINDING_STREAM) readonly buffer NookStream {
  uvec4 nook_stream[];
};

struct NookRecord {
  uint first_bone;    // three rows of each 3x4 matrix
  uint first_sphere;  // in the scene's spheres
  uint place;         // of the instance in its chunk
  bool self;          // its spheres darken it
  uint light;         // as light_layout.h has it; 0: none
  uint first_caster, caster_count;
  uint first_exact, exact_count;
};

NookRecord nook_read_record(uint instance) {
  uint first = uint(NOOK_RECORD_UVEC4S) * instance;
  uvec4 a = nook_stream[first], b = nook_stream[first + 1u];
  return NookRecord(a.x, a.y, a.z & NOOK_RECORD_PLACE, (a.z & NOOK_RECORD_SELF) != 0u, a.w, b.x, b.y, b.z, b.w);
}

vec4 nook_streamed(uint place) { return uintBitsToFloat(nook_stream[place]); }
