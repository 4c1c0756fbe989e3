// The normal of a pixel: that of the host, or one that is reconstructed from depth.
#include "shaders/nnao/depth.glsl"

uniform sampler2D nook_host_normal;

// Returns a value that is linear in pixels over a plane.
float nook_screen_linear(float depth) {
  return nook_orthographic ? depth : 1.0 / depth;
}

// Returns the distance between the pixel and the line through the two pixels on one side, or the distance to
// the nearer one if the other does not exist.
float nook_side_error(float linear, float near, float far) {
  if (near == nook_no_surface) return nook_no_surface;
  float guess = nook_screen_linear(near);
  if (far != nook_no_surface) guess = 2.0 * guess - nook_screen_linear(far);
  return abs(guess - linear);
}

// Returns the difference between a pixel and its neighbour. Each side is weighted by how well it continues
// the pixel's own surface, so that normals do not lean over edges. On a sliver one pixel wide, which neither
// side continues, both sides balance.
vec3 nook_slope(ivec2 pixel, ivec2 axis, float depth, vec3 position) {
  float before = nook_screen_depth(pixel - axis), after = nook_screen_depth(pixel + axis);
  float linear = nook_screen_linear(depth);
  float before_error = nook_side_error(linear, before, nook_screen_depth(pixel - 2 * axis));
  float after_error = nook_side_error(linear, after, nook_screen_depth(pixel + 2 * axis));
  // A distance of more than this many pixel widths is an edge. With edges on both sides, as on a wire, the
  // slope is unknown; a slope of 0 keeps the normal from turning sideways.
  float width = abs(dot(nook_screen_rays.xz, vec2(axis))) * (nook_orthographic ? 1.0 : linear);
  if (min(before_error, after_error) > 8.0 * width)
    return nook_position(nook_screen_rays, pixel + axis, depth) - position;
  float before_share = min(before_error / width, 1.0e6), after_share = min(after_error / width, 1.0e6);
  before_share = 1.0 / (before_share * before_share + 1.0e-4);
  after_share = 1.0 / (after_share * after_share + 1.0e-4);
  // Where there is no surface, the pixel's own depth is used, so that nothing overflows.
  vec3 from = nook_position(nook_screen_rays, pixel - axis, before == nook_no_surface ? depth : before);
  vec3 to = nook_position(nook_screen_rays, pixel + axis, after == nook_no_surface ? depth : after);
  return (position - from) * before_share + (to - position) * after_share;
}

vec3 nook_rebuilt_normal(ivec2 pixel, float depth, vec3 position) {
  vec3 viewer = nook_to_viewer(position);
  vec3 n = cross(nook_slope(pixel, ivec2(1, 0), depth, position), nook_slope(pixel, ivec2(0, 1), depth, position));
  float size = length(n);
  if (!(size > 0.0)) return viewer;
  n /= size;
  return dot(n, viewer) < 0.0 ? -n : n;
}

vec3 nook_pixel_normal(ivec2 pixel, float depth) {
  if (nook_has_normals) {
    vec3 stored = texelFetch(nook_host_normal, pixel + nook_origin, 0).xyz;
    vec3 n = nook_normal_matrix * (stored * nook_normal_scale + nook_normal_bias);
    float size = length(n);
    // A size outside these bounds means that nothing, or no normal, was drawn here.
    if (size > 1.0e-3 && size < 1.0e6) return n / size;
  }
  return nook_rebuilt_normal(pixel, depth, nook_position(nook_screen_rays, pixel, depth));
}
