// Copies bones from the poses on the GPU to the stream, from which the other passes of the update read bones.
// There is one group for each instance of the update. If a value of the pose is not finite or too large, the
// instance gets an AO of 1, which means fully open, and does not occlude other instances.
#include "shaders/character/layout.h"

layout(local_size_x = NOOK_GROUP_SIZE) in;

layout(std430, binding = NOOK_BINDING_STREAM) buffer NookStream {
  uvec4 nook_stream[];  // begins with the records of instance.glsl
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookPosed {
  vec4 nook_posed[];  // written by pose_convert.comp
};

layout(location = NOOK_LOCATION_PLACED_BONE_COUNT) uniform uint nook_bone_count;

void main() {
  uint record = uint(NOOK_RECORD_UVEC4S) * gl_WorkGroupID.x;
  uvec4 head = nook_stream[record];
  // Wait until every thread has read the record, because the first thread may change it.
  barrier();
  if ((head.z & NOOK_RECORD_POSED) != 0u) {
    uint rows = uint(NOOK_BONE_ROWS) * nook_bone_count;
    uint first = (head.z & NOOK_RECORD_PLACE) * (1u + rows);
    bool is_bad = nook_posed[first].x != 0.0;
    for (uint i = gl_LocalInvocationID.x; i < rows; i += uint(NOOK_GROUP_SIZE))
      nook_stream[head.x + i] = floatBitsToUint(is_bad ? vec4(0.0) : nook_posed[first + 1u + i]);
    if (is_bad && gl_LocalInvocationID.x == 0u) {
      uvec4 tail = nook_stream[record + 1u];
      nook_stream[record] = uvec4(head.xy, head.z & ~NOOK_RECORD_SELF, head.w);
      nook_stream[record + 1u] = uvec4(tail.x, 0u, tail.z, 0u);
    }
  }
}
