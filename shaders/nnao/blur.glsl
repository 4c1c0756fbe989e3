// Half of a separable bilateral blur: along one axis.
#include "shaders/nnao/layout.h"

uniform sampler2D nook_ao;
uniform ivec2 nook_blur_axis;
uniform int nook_blur_reach;  // texels; 0: none

// A box of 4 between the pixels, then (1, 2, 1) / 4: any noise with a period of 4 pixels averages out exactly.
const float nook_blur_weights[NOOK_BLUR_REACH + 1] = float[NOOK_BLUR_REACH + 1](1.0, 0.875, 0.5, 0.125);

float nook_ao_at(ivec2 texel) {
  return texelFetch(nook_ao, texel + nook_ao_origin, 0).r;
}

// Returns the weight of a texel at `offset` from the pixel: 0 if it is off the pixel's plane or around a
// corner. Within a quarter of the radius a small weight remains, for pixels whose normal differs from all
// neighbours.
float nook_same_surface(ivec2 at, float depth, vec3 position, vec3 normal, float radius) {
  vec3 offset = nook_position(nook_surface_rays, at, depth) - position;
  float turn = max(dot(nook_surface_normal(at), normal), 0.0);
  turn *= turn;
  turn *= turn;
  float off_plane = abs(dot(offset, normal)) * nook_blur_sharpness / radius;
  float near = 0.02 * max(1.0 - 4.0 * length(offset) / radius, 0.0);
  return max(max(1.0 - off_plane, 0.0) * turn * turn, near);
}

float nook_blurred(ivec2 texel) {
  float centre = nook_ao_at(texel);
  float depth = nook_surface_depth(texel);
  if (depth == nook_no_surface || nook_blur_reach == 0) return centre;
  vec3 position = nook_position(nook_surface_rays, texel, depth);
  vec3 normal = nook_surface_normal(texel);
  float radius = nook_pixel_radius(nook_pixel_scale(depth)).x;
  float sum = 0.0, weights = 0.0;
  for (int i = 1; i <= nook_blur_reach; ++i)
    for (int side = -1; side <= 1; side += 2) {
      ivec2 at = texel + side * i * nook_blur_axis;
      float at_depth = nook_surface_depth(at);
      if (at_depth == nook_no_surface) continue;
      float weight = nook_blur_weights[i] * nook_same_surface(at, at_depth, position, normal, radius);
      sum += weight * nook_ao_at(at);
      weights += weight;
    }
  // The AO of a surface one pixel wide, or with a wrong normal, follows its neighbourhood.
  float own = clamp(2.0 * weights - 0.12, 0.005, 1.0);
  return (sum + own * centre) / (weights + own);
}
