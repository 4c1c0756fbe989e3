// The linear layer. Computes the AO of every vertex from a few key points, in file order. There is one thread
// for each vertex; the y coordinate is the instance. NOOK_OUTPUT is one of
//   NOOK_OUTPUT_AO      AO, one float for each vertex;
//   NOOK_OUTPUT_COLOUR  directional occlusion of instances with a light, three floats;
//   NOOK_OUTPUT_GREY    AO in all three channels, for instances without a light whose chunk also contains
//                       instances with a light.
#include "shaders/character/instance.glsl"
#include "shaders/character/linear.glsl"

layout(local_size_x = NOOK_VERTEX_GROUP_SIZE) in;

layout(std430, binding = NOOK_BINDING_VERTEX_INPUT) readonly buffer NookKeyPoints {
#if NOOK_OUTPUT == NOOK_OUTPUT_COLOUR
  vec4 nook_colour[];  // two for each key point: (colour that multiplies the shadow, shadow), then the
                       // added occlusion of each channel
#else
  vec2 nook_shadow[];  // shadow, added occlusion
#endif
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookLinear {
  // First comes the index of the welded vertex for each file vertex. Then come arrays over the welded
  // vertices: bias; key points, packed two to a word; alphas; blend weights.
  uint nook_linear[];
};
layout(std430, binding = NOOK_BINDING_AO) writeonly buffer NookAo {
  float nook_ao[];
};

layout(location = NOOK_LOCATION_FILE_VERTEX_COUNT) uniform uint nook_file_vertex_count;
layout(location = NOOK_LOCATION_VERTEX_COUNT) uniform uint nook_vertex_count;
layout(location = NOOK_LOCATION_INFLUENCE_PAIRS) uniform uint nook_influence_pairs;
layout(location = NOOK_LOCATION_VERTEX_SHADOW_STRIDE) uniform uint nook_shadow_stride;

#if NOOK_OUTPUT == NOOK_OUTPUT_COLOUR
#define NOOK_SHADOW vec4
#define NOOK_ADDED vec3
#else
#define NOOK_SHADOW float
#define NOOK_ADDED float
#endif

// Adds the contribution of a key point. `weights` are its alpha and its blend weight.
void nook_add(inout NOOK_SHADOW shadow, inout NOOK_ADDED added, uint key_point, vec2 weights) {
#if NOOK_OUTPUT == NOOK_OUTPUT_COLOUR
  vec4 coloured = nook_colour[uint(NOOK_COLOUR_VEC4S) * key_point];
  shadow += weights.x * coloured.w * vec4(coloured.xyz, 1.0);
  added += weights.y * nook_colour[uint(NOOK_COLOUR_VEC4S) * key_point + 1u].xyz;
#else
  vec2 point = nook_shadow[key_point];
  shadow += weights.x * point.x;
  added += weights.y * point.y;
#endif
}

void main() {
  uint file_vertex = gl_GlobalInvocationID.x;
  if (file_vertex >= nook_file_vertex_count) return;
  NookRecord record = nook_read_record(gl_WorkGroupID.y);
#if NOOK_OUTPUT == NOOK_OUTPUT_COLOUR
  if (record.light == 0u) return;
#elif NOOK_OUTPUT == NOOK_OUTPUT_GREY
  if (record.light != 0u) return;
#endif
  uint first_key_point = record.place * nook_shadow_stride;
  uint word = nook_file_vertex_count + nook_linear[file_vertex];
  float bias = record.self ? uintBitsToFloat(nook_linear[word]) : 0.0;
  NOOK_SHADOW shadow = NOOK_SHADOW(0.0);
  NOOK_ADDED added = NOOK_ADDED(0.0);
  for (uint i = 0u; i < nook_influence_pairs; ++i) {
    uint pair = nook_linear[word + (1u + i) * nook_vertex_count];
    uint alpha = word + (1u + nook_influence_pairs + 2u * i) * nook_vertex_count;
    uint blend = alpha + 2u * nook_influence_pairs * nook_vertex_count;
    nook_add(shadow, added, first_key_point + (pair & 0xffffu),
             vec2(uintBitsToFloat(nook_linear[alpha]), uintBitsToFloat(nook_linear[blend])));
    nook_add(shadow, added, first_key_point + (pair >> 16),
             vec2(uintBitsToFloat(nook_linear[alpha + nook_vertex_count]),
                  uintBitsToFloat(nook_linear[blend + nook_vertex_count])));
  }
  uint vertex = record.place * nook_file_vertex_count + file_vertex;
#if NOOK_OUTPUT == NOOK_OUTPUT_AO
  float ao = nook_form(shadow, added, bias);
  nook_ao[vertex] = ao + record.hidden * (1.0 - ao);
#elif NOOK_OUTPUT == NOOK_OUTPUT_GREY
  float ao = nook_form(shadow, added, bias);
  ao += record.hidden * (1.0 - ao);
  for (uint c = 0u; c < 3u; ++c) nook_ao[3u * vertex + c] = ao;
#else
  vec3 open = nook_combine_light(shadow, added, bias);
  open += record.hidden * (1.0 - open);
  for (uint c = 0u; c < 3u; ++c) nook_ao[3u * vertex + c] = open[c];
#endif
}
