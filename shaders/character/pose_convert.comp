// Converts transforms in the host's buffer to the bones of instances. There is one group for each instance.
// The bones of the instance are distributed over the threads of its group. The bones are relative to the
// origin of the instance, and stay valid until the next call.
#include "shaders/character/layout.h"
#include "shaders/character/nearest_similarity.glsl"

layout(local_size_x = NOOK_GROUP_SIZE) in;

// The buffer begins with four elements for each bone. The first three are the rows of the matrix by which the
// bone's transform is multiplied. The fourth contains the position of the bone's joint in rest space, and the
// index of the bone's transform. Then come five elements for each instance. The first three are the rows of
// the instance's place, relative to its origin. In the fourth, x is the first word of the instance's
// transforms, y is the window that contains this word, and z is the instance's place in the chunk. w is the
// first element of the instance's earlier bones, or 0 if there are none. The fifth is the vector by which
// earlier bones must be moved, because the origin of the instance has changed. The earlier bones come last.
layout(std430, binding = NOOK_BINDING_STREAM) readonly buffer NookJobs {
  uvec4 nook_job[];
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookTransforms {
  uint nook_word[];
};
// For each place of the chunk, there is first one element, whose x is 1 if the pose contains a value that is
// not finite or too large. Then come three rows for each bone.
layout(std430, binding = NOOK_BINDING_SPHERES) buffer NookPosed {
  vec4 nook_posed[];
};

layout(location = NOOK_LOCATION_POSE_BONE_COUNT) uniform uint nook_bone_count;
layout(location = NOOK_LOCATION_POSE_LAYOUT) uniform int nook_layout;  // nook_transform_layout
layout(location = NOOK_LOCATION_POSE_IS_HALF) uniform int nook_is_half;
layout(location = NOOK_LOCATION_POSE_STRIDE_WORDS) uniform uint nook_stride_words;
layout(location = NOOK_LOCATION_POSE_WINDOW) uniform uint nook_window;

shared uint nook_is_bad;

struct NookRows {
  vec4 x, y, z;
};

float nook_number(uint first_word, uint index) {
  if (nook_is_half == 0) return uintBitsToFloat(nook_word[first_word + index]);
  vec2 pair = unpackHalf2x16(nook_word[first_word + index / 2u]);
  return (index & 1u) == 0u ? pair.x : pair.y;
}

vec4 nook_four(uint word, uint index) {
  return vec4(nook_number(word, index), nook_number(word, index + 1u), nook_number(word, index + 2u),
              nook_number(word, index + 3u));
}
vec3 nook_three(uint word, uint index) {
  return vec3(nook_number(word, index), nook_number(word, index + 1u), nook_number(word, index + 2u));
}

// Returns the rows of a transform: a scale, then a rotation by a quaternion of any length, then a
// translation. Instead of normalising the quaternion, the rotation is divided by its squared length, which
// causes fewer rounding errors.
NookRows nook_of_quaternion(vec4 q, vec3 scale, vec3 move) {
  float s = 2.0 / dot(q, q);
  vec3 x = vec3(1.0 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y - q.z * q.w), s * (q.x * q.z + q.y * q.w));
  vec3 y = vec3(s * (q.x * q.y + q.z * q.w), 1.0 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z - q.x * q.w));
  vec3 z = vec3(s * (q.x * q.z - q.y * q.w), s * (q.y * q.z + q.x * q.w), 1.0 - s * (q.x * q.x + q.y * q.y));
  return NookRows(vec4(x * scale, move.x), vec4(y * scale, move.y), vec4(z * scale, move.z));
}

// nook_layout is a value of nook_transform_layout.
NookRows nook_transform(uint word) {
  if (nook_layout <= 1) return NookRows(nook_four(word, 0u), nook_four(word, 4u), nook_four(word, 8u));
  if (nook_layout <= 3) {
    uint column = nook_layout == 2 ? 4u : 3u;
    vec3 a = nook_three(word, 0u), b = nook_three(word, column), c = nook_three(word, 2u * column),
         d = nook_three(word, 3u * column);
    return NookRows(vec4(a.x, b.x, c.x, d.x), vec4(a.y, b.y, c.y, d.y), vec4(a.z, b.z, c.z, d.z));
  }
  if (nook_layout == 4) {
    // Kavan, Collins, Zara, O'Sullivan 2008, section 3: the translation is 2 * dual * conjugate(real).
    vec4 real = nook_four(word, 0u), dual = nook_four(word, 4u);
    vec3 move = dual.xyz * real.w - dual.w * real.xyz - cross(dual.xyz, real.xyz);
    return nook_of_quaternion(real, vec3(1.0), 2.0 / dot(real, real) * move);
  }
  return nook_of_quaternion(nook_four(word, 3u), nook_three(word, 7u), nook_three(word, 0u));
}

vec4 nook_job_floats(uint at) { return uintBitsToFloat(nook_job[at]); }
NookRows nook_job_rows(uint at) {
  return NookRows(nook_job_floats(at), nook_job_floats(at + 1u), nook_job_floats(at + 2u));
}

// The product applies `b` first.
vec4 nook_row_product(vec4 a, NookRows b) { return a.x * b.x + a.y * b.y + a.z * b.z + vec4(0.0, 0.0, 0.0, a.w); }
NookRows nook_product(NookRows a, NookRows b) {
  return NookRows(nook_row_product(a.x, b), nook_row_product(a.y, b), nook_row_product(a.z, b));
}

// Compares the bits of floats as integers. For positive floats, both comparisons give the same result. As
// integers, infinities and NaN are larger than all finite floats. A comparison of floats is not safe, because
// compilers may assume that NaN does not occur.
bool nook_is_within(vec4 row) {
  uvec4 bits = floatBitsToUint(row) & 0x7fffffffu;
  uint scale = floatBitsToUint(NOOK_POSE_MAX_SCALE), metres = floatBitsToUint(NOOK_POSE_MAX_METRES);
  return bits.x <= scale && bits.y <= scale && bits.z <= scale && bits.w <= metres;
}

// Returns the nearest matrix that has a uniform scale and no shear. The image of the joint does not change.
NookRows nook_evened(NookRows m, vec3 joint) {
  mat3 axes = mat3(m.x.x, m.y.x, m.z.x, m.x.y, m.y.y, m.z.y, m.x.z, m.y.z, m.z.z);
  if (nook_is_kept(axes)) return m;
  mat3 even = nook_nearest_similarity(axes);
  vec3 move = axes * joint + vec3(m.x.w, m.y.w, m.z.w) - even * joint;
  return NookRows(vec4(even[0].x, even[1].x, even[2].x, move.x), vec4(even[0].y, even[1].y, even[2].y, move.y),
                  vec4(even[0].z, even[1].z, even[2].z, move.z));
}

// Returns the matrix that a bone without a transform keeps, relative to the new origin.
NookRows nook_kept_bone(uint earlier, uint kept, vec3 move) {
  NookRows m;
  if (earlier == 0u)
    m = NookRows(nook_posed[kept], nook_posed[kept + 1u], nook_posed[kept + 2u]);
  else
    m = nook_job_rows(earlier);
  m.x.w += move.x;
  m.y.w += move.y;
  m.z.w += move.z;
  return m;
}

void main() {
  uint job = uint(NOOK_POSE_BIND_UVEC4S) * nook_bone_count + uint(NOOK_POSE_JOB_UVEC4S) * gl_WorkGroupID.x;
  uvec4 where = nook_job[job + 3u];
  // All threads of a group take the same branch, because they belong to one instance.
  if (where.y == nook_window) {
    if (gl_LocalInvocationID.x == 0u) nook_is_bad = 0u;
    barrier();
    NookRows place = nook_job_rows(job);
    vec3 move = nook_job_floats(job + 4u).xyz;
    uint first = where.z * (1u + uint(NOOK_BONE_ROWS) * nook_bone_count);
    for (uint b = gl_LocalInvocationID.x; b < nook_bone_count; b += uint(NOOK_GROUP_SIZE)) {
      uint bind = uint(NOOK_POSE_BIND_UVEC4S) * b, kept = first + 1u + uint(NOOK_BONE_ROWS) * b;
      uvec4 joint = nook_job[bind + 3u];
      NookRows m;
      if (joint.w == NOOK_POSE_NO_TRANSFORM) {
        m = nook_kept_bone(where.w == 0u ? 0u : where.w + uint(NOOK_BONE_ROWS) * b, kept, move);
      } else {
        NookRows transform = nook_transform(where.x + joint.w * nook_stride_words);
        m = nook_product(nook_product(place, transform), nook_job_rows(bind));
      }
      bool is_good = nook_is_within(m.x) && nook_is_within(m.y) && nook_is_within(m.z);
      if (!is_good)
        atomicOr(nook_is_bad, 1u);
      else if (joint.w != NOOK_POSE_NO_TRANSFORM)
        m = nook_evened(m, uintBitsToFloat(joint.xyz));
      nook_posed[kept] = m.x;
      nook_posed[kept + 1u] = m.y;
      nook_posed[kept + 2u] = m.z;
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u) nook_posed[first] = vec4(float(nook_is_bad), 0.0, 0.0, 0.0);
  }
}
