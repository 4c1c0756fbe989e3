// Decodes the bones of baked clips, and writes them to the stream, from which the other passes of the update
// read bones. There is one group for each instance of the update. The bones of the instance are distributed
// over the threads of its group. decode_bone in sdk/src/character/loaded_clips.cpp does the same on the CPU.
#include "shaders/character/layout.h"
#include "shaders/character/nearest_similarity.glsl"

layout(local_size_x = NOOK_GROUP_SIZE) in;

// The stream begins with the records of instance.glsl. This shader overwrites the bones of an instance in the
// stream. Before that, the same elements contain its input. The first three elements are the rows of the
// instance's place, relative to its origin. The fourth contains two frames and the share of the second frame.
layout(std430, binding = NOOK_BINDING_STREAM) buffer NookStream {
  uvec4 nook_stream[];
};
// The buffer begins with the scale of each mode. Then come the centre and radius of each bone, and the
// weights of each frame. The modes come last, with twelve values for each bone. Weights and mode values are
// 16-bit integers, two in each word.
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookClips {
  uint nook_clip[];
};

layout(location = NOOK_LOCATION_CLIP_NUMBER) uniform uint nook_number;
layout(location = NOOK_LOCATION_CLIP_BONE_COUNT) uniform uint nook_bone_count;
layout(location = NOOK_LOCATION_CLIP_MODE_COUNT) uniform uint nook_mode_count;
layout(location = NOOK_LOCATION_CLIP_FIRST_WEIGHT) uniform uint nook_first_weight;
layout(location = NOOK_LOCATION_CLIP_FIRST_MODE) uniform uint nook_first_mode;

shared uvec4 nook_job[NOOK_CLIP_JOB_UVEC4S];
shared float nook_weight[NOOK_MAX_POSE_MODES];  // the weight of each mode at the time of the instance

float nook_low(uint word) { return float(int(word << 16) >> 16); }
float nook_high(uint word) { return float(int(word) >> 16); }
vec2 nook_two(uint at) { return vec2(nook_low(nook_clip[at]), nook_high(nook_clip[at])); }

float nook_frame_weight(uint frame, uint mode) {
  uint index = frame * nook_mode_count + mode;
  uint word = nook_clip[nook_first_weight + (index >> 1)];
  return uintBitsToFloat(nook_clip[mode]) * (1.0 / 32767.0) * ((index & 1u) == 0u ? nook_low(word) : nook_high(word));
}

// Returns the columns of the nearest matrix that has a uniform scale and no shear. Newton's iteration
// computes the polar factor (Higham 1986, equation 3.3). A mix of two frames is close to its polar factor, so
// a few steps are enough.
mat3 nook_evened(mat3 axes) {
  float mean = sqrt((dot(axes[0], axes[0]) + dot(axes[1], axes[1]) + dot(axes[2], axes[2])) / 3.0);
  int steps = mean > 1e-12 && mean < 1e12 ? 12 : 0;
  mat3 turn = mat3(axes[0] / mean, axes[1] / mean, axes[2] / mean);
  float change = 1.0;
  for (int i = 0; i < steps && change > 1e-6; ++i) {
    mat3 cofactor = mat3(cross(turn[1], turn[2]), cross(turn[2], turn[0]), cross(turn[0], turn[1]));
    float determinant = dot(turn[0], cofactor[0]);
    if (!(abs(determinant) > 1e-4)) break;
    mat3 next = mat3(0.5 * (turn[0] + cofactor[0] / determinant), 0.5 * (turn[1] + cofactor[1] / determinant),
                     0.5 * (turn[2] + cofactor[2] / determinant));
    vec3 a = next[0] - turn[0], b = next[1] - turn[1], c = next[2] - turn[2];
    change = max(dot(a, a), max(dot(b, b), dot(c, c)));
    turn = next;
  }
  if (!(change <= 1e-6)) return nook_nearest_similarity(axes);
  float scale = (dot(turn[0], axes[0]) + dot(turn[1], axes[1]) + dot(turn[2], axes[2])) / 3.0;
  return mat3(scale * turn[0], scale * turn[1], scale * turn[2]);
}

void nook_decode(uint bone, uint first) {
  // The twelve values of the bone: three rows of its rotation and scale, and the position of its centre.
  vec2 sums[NOOK_CLIP_BONE_WORDS];
  for (int i = 0; i < NOOK_CLIP_BONE_WORDS; ++i) sums[i] = vec2(0.0);
  uint at = nook_first_mode + uint(NOOK_CLIP_BONE_WORDS) * bone;
  for (uint k = 0u; k < nook_mode_count; ++k) {
    float weight = nook_weight[k];
    for (int i = 0; i < NOOK_CLIP_BONE_WORDS; ++i) sums[i] += weight * nook_two(at + uint(i));
    at += uint(NOOK_CLIP_BONE_WORDS) * nook_bone_count;
  }
  uint span = nook_mode_count + uint(NOOK_CLIP_SPAN_WORDS) * bone;
  vec3 centre = uintBitsToFloat(uvec3(nook_clip[span], nook_clip[span + 1u], nook_clip[span + 2u]));
  float radius = uintBitsToFloat(nook_clip[span + 3u]);
  vec3 x = vec3(sums[0], sums[1].x) / radius, y = vec3(sums[1].y, sums[2]) / radius;
  vec3 z = vec3(sums[3], sums[4].x) / radius, image = vec3(sums[4].y, sums[5]);
  mat3 even = nook_evened(mat3(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z));
  vec3 move = image - even * centre;
  for (uint row = 0u; row < uint(NOOK_BONE_ROWS); ++row) {
    vec4 place = uintBitsToFloat(nook_job[row]);
    vec4 product = vec4(place.xyz * even, dot(place.xyz, move) + place.w);
    nook_stream[first + uint(NOOK_BONE_ROWS) * bone + row] = floatBitsToUint(product);
  }
}

void main() {
  uvec4 head = nook_stream[uint(NOOK_RECORD_UVEC4S) * gl_WorkGroupID.x];
  // All threads of a group take the same branch, because they belong to one instance.
  if (((head.z >> NOOK_RECORD_CLIPS_SHIFT) & NOOK_RECORD_CLIPS_MASK) == nook_number) {
    uint thread = gl_LocalInvocationID.x;
    if (thread < uint(NOOK_CLIP_JOB_UVEC4S)) nook_job[thread] = nook_stream[head.x + thread];
    // The bones will overwrite the instance's input in the stream. So wait until every thread has copied the
    // part that it needs.
    barrier();
    uvec4 frames = nook_job[NOOK_BONE_ROWS];
    float share = uintBitsToFloat(frames.z);
    for (uint k = thread; k < nook_mode_count; k += uint(NOOK_GROUP_SIZE)) {
      float first = nook_frame_weight(frames.x, k);
      nook_weight[k] = (first + share * (nook_frame_weight(frames.y, k) - first)) * (1.0 / 32767.0);
    }
    barrier();
    for (uint b = thread; b < nook_bone_count; b += uint(NOOK_GROUP_SIZE)) nook_decode(b, head.x);
  }
}
