// Code that the baselines share. Each baseline must define the function baseline_ao. The code in this file
// calls it for pixels with a surface.
#include "bakers/measure/nnao/shaders/surface.glsl"

uniform float radius_scale;  // tuned radius divided by the radius of the request
uniform float power;         // tuned exponent of the AO
uniform int groups;          // groups of taps: directions, slices, or 1
uniform int steps;           // taps per group, or per half of a slice

out float result;

const float pi = 3.14159265;

// Returns two random numbers in (0, 1). In each block of 4 x 4 pixels, each number takes 16 different values,
// so that the blur averages the noise out. All methods use the same noise.
vec2 pixel_noise() {
  uvec2 at = uvec2(gl_FragCoord.xy);
  uint across = at.x ^ at.y;
  uint rank = (across & 1u) << 3 | (at.y & 1u) << 2 | (across & 2u) | (at.y & 2u) >> 1;
  uint reversed = (rank & 1u) << 3 | (rank & 2u) << 1 | (rank & 4u) >> 1 | (rank & 8u) >> 3;
  return (vec2(rank, reversed) + 0.5) / 16.0;
}

// What a tap outside the screen reads. 0: the tap finds no surface. 1: the tap moves to the nearest pixel on
// the screen. 2: the tap keeps its position but uses the depth of the nearest pixel on the screen, like a
// clamping sampler.
#ifndef NOOK_BORDER
#define NOOK_BORDER 0
#endif

// Returns the depth that a tap reads at the pixel `at`. If NOOK_BORDER is 1, moves `at` onto the screen.
float tap_depth(inout ivec2 at) {
#if NOOK_BORDER == 0
  return depth_at(at);
#else
  ivec2 inside = clamp(at, ivec2(0), size_px - 1);
#if NOOK_BORDER == 1
  at = inside;
  // A pixel does not occlude itself.
  if (at == ivec2(gl_FragCoord.xy)) return no_surface;
#endif
  float depth = texelFetch(depth_image, inside, 0).r;
  return depth < no_surface ? depth : no_surface;
#endif
}

// Returns the pixel that shows a view-space position.
ivec2 pixel_of(vec3 position) {
  return ivec2(floor((position.xy / -position.z - screen_rays.yw) / screen_rays.xz));
}

ivec2 stepped(vec2 direction, float distance_px) {
  return ivec2(floor(gl_FragCoord.xy + direction * distance_px));
}

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise);

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  result = 1.0;
  if (depth == no_surface) return;
  float open = baseline_ao(pixel, position_at(pixel, depth), normal_at(pixel), pixel_radius(depth) * radius_scale,
                       pixel_noise());
  result = pow(clamp(open, 0.0, 1.0), power);
}
