// Declares the buffer from which compute passes read an instance's data, and the record that tells where the
// data are. Positions are relative to the instance's origin, so that a scene far from the world's origin
// keeps its precision.
#include "shaders/character/constants.h"
#include "shaders/character/layout.h"

// The data that the CPU uploads for an update of the chunk: records, bones, casters and lights. Floats are
// stored as their bits. The first_* fields of a record are indices into this stream, except for first_sphere.
layout(std430, binding = NOOK_BINDING_STREAM) readonly buffer NookStream {
  uvec4 nook_stream[];
};

struct NookRecord {
  uint first_bone;    // each bone has the three rows of its 3x4 matrix
  uint first_sphere;  // index into the scene's spheres
  uint place;         // index of the instance in its chunk
  bool self;          // true if the instance's own spheres darken it
  uint light;         // index of the light, whose layout is in light_layout.h; 0: no light
  uint first_caster, caster_count;
  uint first_exact, exact_count;
  float hidden;       // share of the AO that is hidden while the instance fades in
};

NookRecord nook_read_record(uint instance) {
  uint first = uint(NOOK_RECORD_UVEC4S) * instance;
  uvec4 a = nook_stream[first], b = nook_stream[first + 1u];
  return NookRecord(a.x, a.y, a.z & NOOK_RECORD_PLACE, (a.z & NOOK_RECORD_SELF) != 0u, a.w, b.x, b.y, b.z,
                    b.w & NOOK_RECORD_EXACT_COUNT,
                    float(b.w >> NOOK_RECORD_HIDDEN_SHIFT) / float(NOOK_HIDDEN_STEPS));
}

vec4 nook_streamed(uint place) { return uintBitsToFloat(nook_stream[place]); }
