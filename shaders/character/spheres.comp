// For every instance that moved, transforms the proxy spheres from rest space to world axes, relative to the
// instance's origin. There is one thread for each sphere; the y coordinate is the instance.
#include "shaders/character/instance.glsl"

layout(local_size_x = NOOK_GROUP_SIZE) in;

layout(std430, binding = NOOK_BINDING_SPHERES) writeonly buffer NookSpheres {
  vec4 nook_sphere[];  // two for each: centre, 1 / radius; caster weight
};
layout(std430, binding = NOOK_BINDING_MODEL) readonly buffer NookRestSpheres {
  vec4 nook_rest_sphere[];  // two for each: centre, radius; bone, caster weight
};

layout(location = NOOK_LOCATION_SPHERES_COUNT) uniform uint nook_sphere_count;

void main() {
  uint s = gl_GlobalInvocationID.x;
  if (s >= nook_sphere_count) return;
  NookRecord record = nook_read_record(gl_WorkGroupID.y);
  uint first = uint(NOOK_REST_SPHERE_VEC4S) * s;
  vec4 rest = nook_rest_sphere[first];
  vec2 rider = nook_rest_sphere[first + 1u].xy;
  uint row = record.first_bone + uint(NOOK_BONE_ROWS) * uint(rider.x);
  vec4 p = vec4(rest.xyz, 1.0);
  vec4 x = nook_streamed(row);
  vec3 centre = vec3(dot(x, p), dot(nook_streamed(row + 1u), p), dot(nook_streamed(row + 2u), p));
  // The matrices are rigid or have a uniform scale, so the length of each row of the linear part is the
  // scale.
  float radius = rest.w * length(x.xyz);
  uint place = uint(NOOK_SPHERE_VEC4S) * (record.first_sphere + s);
  nook_sphere[place] = vec4(centre, 1.0 / max(radius, NOOK_MIN_SPHERE_RADIUS));
  nook_sphere[place + 1u] = vec4(rider.y, 0.0, 0.0, 0.0);
}
