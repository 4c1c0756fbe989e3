// Writes each value to its own word in a host's buffer. The words are nook_stride words apart.
#include "shaders/character/pack.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer NookSource {
  float nook_source[];
};
layout(std430, binding = 1) writeonly buffer NookTarget {
  uint nook_target[];
};

layout(location = 0) uniform uint nook_count;
layout(location = 1) uniform uint nook_first_source;  // index of the first value to read
layout(location = 2) uniform uint nook_first_target;  // index of the first word to write
layout(location = 3) uniform uint nook_stride;        // words

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < nook_count) nook_target[nook_first_target + i * nook_stride] = nook_packed(nook_source[nook_first_source + i]);
}
