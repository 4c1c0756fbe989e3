// From the key points that a coarser level of detail evaluates to all of them. One thread a key point; y is the instance.
#include "shaders/character/instance.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 5) buffer NookShadows {
  vec2 nook_shadow[];  // all key points, then the evaluated ones
};
layout(std430, binding = 6) readonly buffer NookSpread {
  uint nook_spread[];  // for each level and key point: evaluated key point, scale, offset
};

layout(location = 0) uniform uint nook_first_record;
layout(location = 1) uniform uint nook_key_point_count;
layout(location = 2) uniform uint nook_shadow_stride;
layout(location = 3) uniform int nook_self;
layout(location = 4) uniform uint nook_level;

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= nook_key_point_count) return;
  NookRecord record = nook_read_record(nook_first_record + gl_WorkGroupID.y);
  uint first = record.place * nook_shadow_stride;
  uint rule = 3u * (nook_level * nook_key_point_count + k);
  vec2 source = nook_shadow[first + nook_key_point_count + nook_spread[rule]];
  // Scale and offset belong to self-shadow.
  if (nook_self != 0)
    source.x = max(uintBitsToFloat(nook_spread[rule + 1u]) * source.x + uintBitsToFloat(nook_spread[rule + 2u]), 0.0);
  nook_shadow[first + k] = source;
}
