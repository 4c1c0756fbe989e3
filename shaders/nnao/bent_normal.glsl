// Encodes the bent normal in two channels beside AO and edges. The code consists of two coordinates of the
// unit vector, with 8 bits each. They are its coordinates in the plane perpendicular to the direction to the
// viewer. Filters can average these coordinates directly. If a bent normal points away from the viewer, it is
// replaced by the nearest direction in that plane.
#include "shaders/nnao/frame.glsl"

// Maps coordinates in [-1, 1] to [0, 1] for storage in 8 bits. The coordinate 0 is represented exactly.
vec2 nook_coded(vec2 coordinates) {
  return (127.0 * coordinates + 128.0) / 255.0;
}

vec2 nook_decoded(vec2 coded) {
  return (255.0 * coded - 128.0) / 127.0;
}

// Rotates v by the rotation that turns the unit vector `from` into the unit vector `to`.
vec3 nook_turned(vec3 v, vec3 from, vec3 to) {
  vec3 between = from + to;
  return v - between * (dot(v, between) / (1.0 + dot(from, to))) + 2.0 * dot(v, from) * to;
}

vec2 nook_coded_bent_normal(vec3 bent, vec3 viewer) {
  vec3 turned = nook_turned(bent * inversesqrt(max(dot(bent, bent), 1.0e-12)), viewer, vec3(0.0, 0.0, 1.0));
  return nook_coded(turned.z < 0.0 ? turned.xy * inversesqrt(max(dot(turned.xy, turned.xy), 1.0e-12)) : turned.xy);
}

// Returns the bent normal in view space.
vec3 nook_decoded_bent_normal(vec2 coded, ivec2 pixel) {
  vec2 aside = nook_decoded(coded);
  float towards = sqrt(max(1.0 - dot(aside, aside), 0.0));
  vec3 viewer = nook_to_viewer(nook_position(nook_screen_rays, vec2(pixel), 1.0));
  return normalize(nook_turned(vec3(aside, towards), vec3(0.0, 0.0, 1.0), viewer));
}
