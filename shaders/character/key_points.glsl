// The declarations that the passes over key points share. There is one thread for each key point; the y
// coordinate is the instance. Spheres are first copied to shared memory, and all threads of the group read
// them there.
#include "shaders/character/instance.glsl"
#include "shaders/character/kernel.glsl"

const uint nook_tile_size = uint(NOOK_GROUP_SIZE);
layout(local_size_x = NOOK_GROUP_SIZE) in;

// The stream has two elements for each caster: (the caster's origin minus the receiver's origin, index of the
// first sphere) and (number of spheres). For each exact sphere, the stream also has one element: (centre,
// 1 / radius).
layout(std430, binding = NOOK_BINDING_SPHERES) readonly buffer NookSpheres {
  vec4 nook_sphere[];  // two for each: centre, 1 / radius; caster weight
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookKeyPoints {
  vec4 nook_rest_key_point[];  // six for each: position, saturation; normal; surface position; surface normal; bones; weights
};

layout(location = NOOK_LOCATION_FIRST_RECORD) uniform uint nook_first_record;
layout(location = NOOK_LOCATION_FIRST_SPHERE) uniform uint nook_first_sphere;  // first sphere of the level of
                                                                               // detail, relative to the
                                                                               // instance's first sphere
layout(location = NOOK_LOCATION_SPHERE_COUNT) uniform uint nook_sphere_count;
layout(location = NOOK_LOCATION_FIRST_KEY_POINT) uniform uint nook_first_key_point;  // first key point of the level of detail
layout(location = NOOK_LOCATION_KEY_POINT_COUNT) uniform uint nook_key_point_count;
layout(location = NOOK_LOCATION_GAMMA) uniform float nook_gamma;
layout(location = NOOK_LOCATION_COMPOSED) uniform int nook_composed;  // 0: the paper's form, where one norm
                                                                      // sums the spheres of the casters and
                                                                      // of the body itself
layout(location = NOOK_LOCATION_SHADOW_STRIDE) uniform uint nook_shadow_stride;
layout(location = NOOK_LOCATION_SHADOW_OFFSET) uniform uint nook_shadow_offset;  // offset within the instance's shadows

shared vec4 nook_tile[nook_tile_size];
shared float nook_tile_weight[nook_tile_size];

struct NookPoint {
  vec3 position, normal;
};

// Returns the sphere's height above the key point's horizon divided by the radius, and its squared distance
// divided by the squared radius.
vec2 nook_see(vec4 sphere, NookPoint point) {
  vec3 d = (sphere.xyz - point.position) * sphere.w;
  return vec2(dot(d, point.normal), dot(d, d));
}

// Copies spheres to shared memory. Every thread of the group must call it with the same arguments.
void nook_stage(uint first, uint count) {
  barrier();
  uint i = gl_LocalInvocationID.x;
  if (i < count) {
    uint place = uint(NOOK_SPHERE_VEC4S) * (first + i);
    nook_tile[i] = nook_sphere[place];
    nook_tile_weight[i] = nook_sphere[place + 1u].x;
  }
  barrier();
}

// Blends up to four bones linearly. The normal is renormalised. If bones with opposite rotations make it
// zero, it stays zero.
void nook_pose(uint key_point, uint first_bone, out NookPoint fitted, out NookPoint surface) {
  uint k = uint(NOOK_KEY_POINT_VEC4S) * key_point;
  vec4 bones = nook_rest_key_point[k + 4u], weights = nook_rest_key_point[k + 5u];
  vec4 x = vec4(0.0), y = vec4(0.0), z = vec4(0.0);
  for (int b = 0; b < 4; ++b) {
    uint row = first_bone + uint(NOOK_BONE_ROWS) * uint(bones[b]);
    x += weights[b] * nook_streamed(row);
    y += weights[b] * nook_streamed(row + 1u);
    z += weights[b] * nook_streamed(row + 2u);
  }
  for (uint i = 0u; i < 2u; ++i) {
    vec4 p = vec4(nook_rest_key_point[k + 2u * i].xyz, 1.0);
    vec3 n = nook_rest_key_point[k + 2u * i + 1u].xyz;
    n = vec3(dot(x.xyz, n), dot(y.xyz, n), dot(z.xyz, n));
    NookPoint posed = NookPoint(vec3(dot(x, p), dot(y, p), dot(z, p)), n * inversesqrt(max(dot(n, n), 1e-30)));
    if (i == 0u)
      fitted = posed;
    else
      surface = posed;
  }
}

// Returns the shadow of a key point. `sum` is the sum of the terms of its spheres.
float nook_shadow_of(float sum, uint key_point) {
  float saturation = nook_rest_key_point[uint(NOOK_KEY_POINT_VEC4S) * (nook_first_key_point + key_point)].w;
  return nook_saturated(nook_norm_root(sum, nook_gamma), saturation);
}
