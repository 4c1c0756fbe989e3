// Declarations that the compute passes share: the places of an instance's data. Positions are relative to the
// instance's origin, so that a scene far from the world's origin keeps its precision.
#include "shaders/character/constants.h"
#include "shaders/character/layout.h"

layout(std430, binding = NOOK_BINDING_RECORDS) readonly buffer NookRecords {
  uvec4 nook_record[];  // two for each instance, see NookRecord
};
layout(std430, binding = NOOK_BINDING_BONES) readonly buffer NookBones {
  vec4 nook_bone[];  // three rows of each 3x4 matrix
};

struct NookRecord {
  uint first_bone;
  uint first_sphere;
  uint place;  // of the instance in its chunk
  uint light;  // 1 + its first texel in the lights; 0: none
  uint first_caster, caster_count;  // in nook_caster
  uint first_exact, exact_count;    // in nook_caster
};

NookRecord nook_read_record(uint instance) {
  uint first = uint(NOOK_RECORD_UVEC4S) * instance;
  uvec4 a = nook_record[first], b = nook_record[first + 1u];
  return NookRecord(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}
