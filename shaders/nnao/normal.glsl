// The normal of a texel of the surface: that of the host, or one that follows from the depths around it.
#include "shaders/nnao/edges.glsl"

uniform sampler2D nook_host_normal;

// Returns the slope along one axis, by the sides that lie on the texel's own surface. With edges on both
// sides, as on a wire, the slope is unknown; 0 keeps the normal from turning sideways.
float nook_axis_slope(vec2 slope, vec2 connected) {
  return dot(slope, connected) / max(connected.x + connected.y, 1.0e-3);
}

vec3 nook_rebuilt_normal(ivec2 texel, nook_neighbours around) {
  vec2 slope = vec2(nook_axis_slope(around.slope.xy, around.connected.xy),
                    nook_axis_slope(around.slope.zw, around.connected.zw)) / nook_surface_rays.xz;
  vec2 ray = nook_surface_rays.xz * vec2(texel) + nook_surface_rays.yw;
  return normalize(vec3(slope, 1.0 + nook_spread.x * dot(ray, slope)));
}

vec3 nook_texel_normal(ivec2 texel, nook_neighbours around) {
  if (nook_has_normals) {
#if NOOK_HALF
    ivec2 pixel = 2 * texel;
#else
    ivec2 pixel = texel;
#endif
    vec3 stored = texelFetch(nook_host_normal, pixel + nook_origin, 0).xyz;
    vec3 n = nook_normal_matrix * (stored * nook_normal_scale + nook_normal_bias);
    float size = length(n);
    // A size outside these bounds means that nothing, or no normal, was drawn here.
    if (size > 1.0e-3 && size < 1.0e6) return n / size;
  }
  return nook_rebuilt_normal(texel, around);
}
