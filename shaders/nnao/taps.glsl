// Computes the positions of a pixel's taps. sdk/src/nnao/taps.h has the same functions.

#include "shaders/nnao/layout.h"

// Returns two values in [0, 1) that look random from texel to texel.
vec2 nook_tap_jitter(ivec2 texel) {
  uint hash = (uint(texel.x) | uint(texel.y) << 16) * 0x7FEB352Du;
  hash = (hash ^ hash >> 15) * 0x846CA68Bu;
  hash ^= hash >> 16;
  return vec2(hash >> 16, hash & 0xFFFFu) / 65536.0;
}

// Returns the noise for rotation and offset. In a block of 3 x 3 pixels, each of the two has one value in
// each ninth of [0, 1). Its position within the ninth is random. If the positions were equal, an edge would
// cast several copies of its shadow, at the same distances for all pixels.
vec2 nook_tap_noise(ivec2 texel) {
  vec2 at = vec2(texel);
  vec2 cell = at - 3.0 * floor((at + 0.5) / 3.0);
  vec2 noise = (cell.xy * 3.0 + cell.yx + nook_tap_jitter(texel)) / 9.0;
#if NOOK_TEMPORAL
  noise = fract(noise + nook_noise_shift);
#endif
  return noise;
}

// Returns the angle of a direction in the x-y plane of view space, in radians.
float nook_direction_angle(int direction, int directions, vec2 noise) {
  return 6.2831853 * (float(direction) + noise.x) / float(directions);
}

// Returns the distance of a step from the pixel, in texels along the screen's y axis.
float nook_step_distance(int tap_step, int steps, vec2 noise, float radius_px) {
  float share = (float(tap_step) + noise.y) / float(steps);
  return max(float(tap_step) + 1.0, radius_px * share * sqrt(share));
}

vec2 nook_horizon_tap(vec2 direction, float distance_px, vec2 scale) {
  return direction * scale * (distance_px / abs(scale.y));
}

const int nook_grid_size = NOOK_GRID_SIZE;
const int nook_grid_cells = nook_grid_size * nook_grid_size;

int nook_paper_tap_cell(int tap, int taps, vec2 noise) {
  return min(int((float(tap) + noise.x) * (float(nook_grid_cells) / float(taps))), nook_grid_cells - 1);
}

// Returns the position of a tap of the paper's form. `scale` is in texels per metre.
vec2 nook_paper_tap(int cell, int taps, vec2 noise, float radius, vec2 scale) {
  vec2 place = vec2(cell % nook_grid_size, cell / nook_grid_size) + 0.5;
  if (taps < nook_grid_cells) place += vec2(noise.y, fract(4.0 * noise.x)) - 0.5;
  return radius * (2.0 * place / float(nook_grid_size) - 1.0) * scale;
}
