// Computes the shadows of all key points from the key points that a coarser level of detail evaluates. There
// is one thread for each key point; the y coordinate is the instance.
#include "shaders/character/instance.glsl"

layout(local_size_x = NOOK_GROUP_SIZE) in;

layout(std430, binding = NOOK_BINDING_KEY_POINTS) buffer NookShadows {
  vec2 nook_shadow[];  // first all key points, then the evaluated ones
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookSpread {
  uint nook_spread[];  // for each level and key point: index of the evaluated key point, scale, offset
};

layout(location = NOOK_LOCATION_SPREAD_FIRST_RECORD) uniform uint nook_first_record;
layout(location = NOOK_LOCATION_SPREAD_KEY_POINT_COUNT) uniform uint nook_key_point_count;
layout(location = NOOK_LOCATION_SPREAD_SHADOW_STRIDE) uniform uint nook_shadow_stride;
layout(location = NOOK_LOCATION_SPREAD_LEVEL) uniform uint nook_level;

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= nook_key_point_count) return;
  NookRecord record = nook_read_record(nook_first_record + gl_WorkGroupID.y);
  uint first = record.place * nook_shadow_stride;
  uint rule = uint(NOOK_SPREAD_WORDS) * (nook_level * nook_key_point_count + k);
  vec2 source = nook_shadow[first + nook_key_point_count + nook_spread[rule]];
  // Scale and offset apply only to self-shadow.
  if (record.self)
    source.x = max(uintBitsToFloat(nook_spread[rule + 1u]) * source.x + uintBitsToFloat(nook_spread[rule + 2u]), 0.0);
  nook_shadow[first + k] = source;
}
