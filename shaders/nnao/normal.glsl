// Computes the normal of a texel of the surface. It is the host's normal, or a normal derived from the depths
// around the texel.
#include "shaders/nnao/edges.glsl"
#include "shaders/nnao/host_images.glsl"

#ifdef NOOK_NORMAL_SAMPLES
uniform NOOK_HOST_SAMPLES nook_host_normal;
#else
uniform NOOK_HOST_IMAGE nook_host_normal;
#endif

// Returns the slope along one axis, which is the mean of the slopes on both sides. The weight of a slope is
// the inverse of its square, because beyond a silhouette, depth changes more steeply than on the texel's own
// surface. On a thin wire, the slopes of both sides cancel, so that the normal does not turn sideways.
float nook_axis_slope(vec2 slope) {
  vec2 steep = slope * slope + 1.0e-12;
  return dot(slope, steep.yx) / (steep.x + steep.y);
}

vec3 nook_rebuilt_normal(ivec2 texel, NookNeighbours around) {
  vec2 slope = vec2(nook_axis_slope(around.slope.xy), nook_axis_slope(around.slope.zw)) / nook_surface_rays.xz;
  vec2 ray = nook_surface_rays.xz * vec2(texel) + nook_surface_rays.yw;
  return normalize(vec3(slope, 1.0 + nook_spread.x * dot(ray, slope)));
}

// Returns the host's texel in the normal texture, for a texel of the surface and its screen pixel.
vec3 nook_stored_normal(ivec2 texel, ivec2 pixel) {
#ifdef NOOK_NORMAL_SAMPLES
  return nook_host_sample(nook_host_normal, pixel, int(texelFetch(nook_depth, texel, 0).g)).xyz;
#else
  return nook_host_texel(nook_host_normal, pixel).xyz;
#endif
}

vec3 nook_texel_normal(ivec2 texel, NookNeighbours around) {
  if (nook_has_normals) {
#if NOOK_HALF
    ivec2 pixel = 2 * texel;
#else
    ivec2 pixel = texel;
#endif
    vec3 n = nook_normal_matrix * (nook_stored_normal(texel, pixel) * nook_normal_scale + nook_normal_bias);
    float size = length(n);
    // If the length is outside these limits, the host has not drawn a normal here.
    if (size > nook_shortest_normal && size < 1.0e6) return n / size;
  }
  return nook_rebuilt_normal(texel, around);
}
