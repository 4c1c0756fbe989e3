// AO of the casters at what the host's depth shows.
#include "shaders/nnao/host_depth.glsl"
#include "shaders/world/casters.glsl"

uniform sampler2D nook_host_normal;
#ifdef NOOK_LAYERED
uniform sampler2D nook_layer;
#endif

out vec4 nook_out;

// The position of a pixel of the viewport; far away where there is no surface.
vec3 nook_world_position(ivec2 pixel) {
  ivec2 inside = clamp(pixel, ivec2(0), nook_screen_size - 1);
  return nook_position(nook_screen_rays, vec2(pixel), nook_screen_depth(inside));
}

// The tangent along an axis from the steps to both neighbours, each weighted by the inverse square of its change of
// depth: past a silhouette depth changes more steeply than on the pixel's own surface.
vec3 nook_world_tangent(vec3 back, vec3 forth) {
  float b = back.z * back.z + 1.0e-12, f = forth.z * forth.z + 1.0e-12;
  return b < f ? back + forth * (b / f) : back * (f / b) + forth;
}

vec3 nook_world_normal(ivec2 pixel, vec3 position) {
  if (nook_has_normals) {
    vec3 stored = texelFetch(nook_host_normal, pixel + nook_origin, 0).xyz;
    vec3 n = nook_normal_matrix * (stored * nook_normal_scale + nook_normal_bias);
    float size = length(n);
    // A size outside these bounds means that nothing, or no normal, was drawn here.
    if (size > 1.0e-3 && size < 1.0e6) return n / size;
  }
  ivec2 right = ivec2(1, 0), up = ivec2(0, 1);
  vec3 x = nook_world_tangent(position - nook_world_position(pixel - right), nook_world_position(pixel + right) - position);
  vec3 y = nook_world_tangent(position - nook_world_position(pixel - up), nook_world_position(pixel + up) - position);
  vec3 n = normalize(cross(x, y));
  return dot(n, nook_to_viewer(position)) < 0.0 ? -n : n;
}

float nook_world_strengthened(float ao) {
  float base = max(1.0 - nook_intensity * (1.0 - ao), 0.0);
  // pow is inexact on some drivers, and open must stay exactly open.
  return nook_power == 1.0 || base == 1.0 ? base : pow(base, nook_power);
}

#ifdef NOOK_LAYERED
// The modes of nook_nnao_layer.
float nook_world_combined(float ao, ivec2 pixel) {
  vec2 layer = texelFetch(nook_layer, pixel + nook_origin, 0).rg;
  if (nook_layer_mode == 3) return mix(ao, layer.r, layer.g);
  float smaller = min(ao, layer.r);
  return nook_layer_mode == 1 ? smaller : layer.r > 0.0 ? smaller / layer.r : 1.0;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  float depth = nook_screen_depth(pixel);
  float ao = 1.0;
  if (depth != nook_no_surface) {
    vec3 position = nook_position(nook_screen_rays, vec2(pixel), depth);
    ao = nook_world_strengthened(nook_world_open(position, nook_world_normal(pixel, position)));
  }
#ifdef NOOK_LAYERED
  ao = nook_world_combined(ao, pixel);
#endif
  nook_out = vec4(vec3(ao), 1.0);
}
