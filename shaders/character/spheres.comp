// Proxy spheres of every instance that moved, rest space to the instance's own space. One thread a sphere; y is the instance.
#include "shaders/character/instance.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 3) writeonly buffer NookSpheres {
  vec4 nook_sphere[];  // centre, 1 / radius
};
layout(std430, binding = 4) writeonly buffer NookWeights {
  float nook_caster_weight[];
};
layout(std430, binding = 6) readonly buffer NookRestSpheres {
  vec4 nook_rest_sphere[];  // two for each: centre, radius; bone, caster weight
};

layout(location = 0) uniform uint nook_sphere_count;

void main() {
  uint s = gl_GlobalInvocationID.x;
  if (s >= nook_sphere_count) return;
  NookRecord record = nook_read_record(gl_WorkGroupID.y);
  vec4 rest = nook_rest_sphere[2u * s];
  vec2 rider = nook_rest_sphere[2u * s + 1u].xy;
  uint row = 3u * (record.first_bone + uint(rider.x));
  vec4 p = vec4(rest.xyz, 1.0);
  vec4 x = nook_bone[row];
  vec3 centre = vec3(dot(x, p), dot(nook_bone[row + 1u], p), dot(nook_bone[row + 2u], p));
  // Under rigid or uniformly scaled matrices every row of the linear part is as long as the scale.
  float radius = rest.w * length(x.xyz);
  nook_sphere[record.first_sphere + s] = vec4(centre, 1.0 / max(radius, nook_min_sphere_radius));
  nook_caster_weight[record.first_sphere + s] = rider.y;
}
