// The linear layer: AO of every vertex in file order from a few key points. There is one thread for each
// vertex; y is the instance. With NOOK_LIGHT the result is directional occlusion, three floats for each
// vertex, which are all AO for an instance without light.
#include "shaders/character/instance.glsl"
#include "shaders/character/linear.glsl"

layout(local_size_x = NOOK_VERTEX_GROUP_SIZE) in;

layout(std430, binding = NOOK_BINDING_SHADOWS) readonly buffer NookShadows {
  vec2 nook_shadow[];
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookLinear {
  // Welded vertex of each file vertex, then for each welded vertex: bias, two key points in a word for each pair of
  // influences, the alphas and the blend weights; each of these as an array over the welded vertices.
  uint nook_linear[];
};
layout(std430, binding = NOOK_BINDING_AO) writeonly buffer NookAo {
  float nook_ao[];
};
#if NOOK_LIGHT
layout(std430, binding = NOOK_BINDING_VERTEX_COLOURS) readonly buffer NookColours {
  vec4 nook_colour[];  // two for each key point: colour that multiplies the shadow; added occlusion
};
#endif

layout(location = NOOK_LOCATION_FILE_VERTEX_COUNT) uniform uint nook_file_vertex_count;
layout(location = NOOK_LOCATION_VERTEX_COUNT) uniform uint nook_vertex_count;
layout(location = NOOK_LOCATION_INFLUENCE_PAIRS) uniform uint nook_influence_pairs;
layout(location = NOOK_LOCATION_VERTEX_SHADOW_STRIDE) uniform uint nook_shadow_stride;
layout(location = NOOK_LOCATION_VERTEX_SELF) uniform int nook_self;

void main() {
  uint file_vertex = gl_GlobalInvocationID.x;
  if (file_vertex >= nook_file_vertex_count) return;
  NookRecord record = nook_read_record(gl_WorkGroupID.y);
  uint first_key_point = record.place * nook_shadow_stride;
  uint word = nook_file_vertex_count + nook_linear[file_vertex];
  float bias = nook_self != 0 ? uintBitsToFloat(nook_linear[word]) : 0.0;
#if NOOK_LIGHT
  bool lit = record.light != 0u;
  vec3 shadow = vec3(0.0), added = vec3(0.0);
#else
  vec2 sum = vec2(0.0);
#endif
  for (uint i = 0u; i < nook_influence_pairs; ++i) {
    uint pair = nook_linear[word + (1u + i) * nook_vertex_count];
    uint alpha = word + (1u + nook_influence_pairs + 2u * i) * nook_vertex_count;
    uint blend = alpha + 2u * nook_influence_pairs * nook_vertex_count;
    vec2 first = vec2(uintBitsToFloat(nook_linear[alpha]), uintBitsToFloat(nook_linear[blend]));
    vec2 second = vec2(uintBitsToFloat(nook_linear[alpha + nook_vertex_count]),
                       uintBitsToFloat(nook_linear[blend + nook_vertex_count]));
#if NOOK_LIGHT
    uint k[2] = uint[2](first_key_point + (pair & 0xffffu), first_key_point + (pair >> 16));
    vec2 weight[2] = vec2[2](first, second);
    for (int j = 0; j < 2; ++j) {
      vec2 grey = nook_shadow[k[j]];
      shadow += weight[j].x * grey.x * (lit ? nook_colour[uint(NOOK_COLOUR_VEC4S) * k[j]].xyz : vec3(1.0));
      added += weight[j].y * (lit ? nook_colour[uint(NOOK_COLOUR_VEC4S) * k[j] + 1u].xyz : vec3(grey.y));
    }
  }
  uint vertex = 3u * (record.place * nook_file_vertex_count + file_vertex);
  for (uint c = 0u; c < 3u; ++c) nook_ao[vertex + c] = nook_combine(shadow[c], added[c], bias);
#else
    sum += first * nook_shadow[first_key_point + (pair & 0xffffu)] +
           second * nook_shadow[first_key_point + (pair >> 16)];
  }
  nook_ao[record.place * nook_file_vertex_count + file_vertex] =
      nook_combine(sum.x, sum.y, bias);
#endif
}
