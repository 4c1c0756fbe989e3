// The colours of key points that a coarser level of detail evaluates to all of them. One thread a key point; y is the instance.
#include "shaders/character/instance.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 5) buffer NookColours {
  vec4 nook_colour[];  // two for each of all key points, then for the evaluated ones
};
layout(std430, binding = 6) readonly buffer NookSpread {
  uint nook_spread[];  // for each level and key point: evaluated key point, scale, offset
};

layout(location = 0) uniform uint nook_first_record;
layout(location = 1) uniform uint nook_key_point_count;
layout(location = 2) uniform uint nook_shadow_stride;
layout(location = 4) uniform uint nook_level;

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= nook_key_point_count) return;
  NookRecord record = nook_read_record(nook_first_record + gl_WorkGroupID.y);
  if (record.light == 0u) return;
  uint first = record.place * nook_shadow_stride;
  uint source = first + nook_key_point_count + nook_spread[3u * (nook_level * nook_key_point_count + k)];
  nook_colour[2u * (first + k)] = nook_colour[2u * source];
  nook_colour[2u * (first + k) + 1u] = nook_colour[2u * source + 1u];
}
