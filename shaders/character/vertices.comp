// The linear layer: AO of every vertex in file order from a few key points. One thread a vertex; y is the instance.
#include "character/instance.glsl"
#include "character/linear.glsl"

layout(local_size_x = 128) in;

layout(std430, binding = 5) readonly buffer NookShadows {
  vec2 nook_shadow[];
};
layout(std430, binding = 6) readonly buffer NookLinear {
  // Welded vertex of each file vertex, then for each welded vertex: bias, two key points in a word for each pair of
  // influences, the alphas and the blend weights; each of these as an array over the welded vertices.
  uint nook_linear[];
};
layout(std430, binding = 7) writeonly buffer NookAo {
  float nook_ao[];
};

layout(location = 0) uniform uint nook_file_vertex_count;
layout(location = 1) uniform uint nook_vertex_count;
layout(location = 2) uniform uint nook_influence_pairs;
layout(location = 3) uniform uint nook_shadow_stride;
layout(location = 4) uniform int nook_self;

void main() {
  uint file_vertex = gl_GlobalInvocationID.x;
  if (file_vertex >= nook_file_vertex_count) return;
  NookRecord record = nook_read_record(gl_WorkGroupID.y);
  uint first_key_point = record.place * nook_shadow_stride;
  uint word = nook_file_vertex_count + nook_linear[file_vertex];
  float bias = nook_self != 0 ? uintBitsToFloat(nook_linear[word]) : 0.0;
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < nook_influence_pairs; ++i) {
    uint pair = nook_linear[word + (1u + i) * nook_vertex_count];
    uint alpha = word + (1u + nook_influence_pairs + 2u * i) * nook_vertex_count;
    uint blend = alpha + 2u * nook_influence_pairs * nook_vertex_count;
    vec2 first = vec2(uintBitsToFloat(nook_linear[alpha]), uintBitsToFloat(nook_linear[blend]));
    vec2 second = vec2(uintBitsToFloat(nook_linear[alpha + nook_vertex_count]),
                       uintBitsToFloat(nook_linear[blend + nook_vertex_count]));
    sum += first * nook_shadow[first_key_point + (pair & 0xffffu)] +
           second * nook_shadow[first_key_point + (pair >> 16)];
  }
  nook_ao[record.place * nook_file_vertex_count + file_vertex] =
      nook_combine(sum.x, sum.y, bias);
}
