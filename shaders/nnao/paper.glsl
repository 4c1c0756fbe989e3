// Evaluates the paper's network; network.h defines it. The input of a tap is
//   (n_t - n, (p_t.z - p.z) / r) clamp(1 - |p_t - p| / r, 0, 1).
#include "shaders/core/texels.glsl"
#include "shaders/nnao/surface_normal.glsl"
uniform NOOK_TEXELS nook_filters;  // four texels for each cell of the grid: one for each input, with the weights of four units
uniform vec4 nook_network[NOOK_PAPER_VEC4S];  // the other layers, in the order of network.h
// The number of groups of NOOK_STEPS taps. It is a uniform. With a constant, compilers would unroll the loop
// into more code than fits into the instruction cache.
uniform int nook_tap_groups;

vec4 nook_prelu(vec4 x, int slopes) {
  return max(x, 0.0) * nook_network[slopes + 1] + min(x, 0.0) * nook_network[slopes];
}

// Returns the contribution of one tap to the four sums.
vec4 nook_tap_sum(ivec2 texel, int cell, int taps, vec2 noise, vec3 position, vec3 normal, vec2 scale, float radius) {
  vec2 offset = nook_paper_tap(cell, taps, noise, radius, scale);
  ivec2 at = ivec2(floor(vec2(texel) + 0.5 + offset));
  if (!nook_inside(at, nook_surface_size)) return vec4(0.0);
  float depth = nook_depth_at(at);
  if (depth == nook_no_surface) return vec4(0.0);
  vec3 v = nook_position(nook_surface_rays, vec2(at), depth) - position;
  float weight = 1.0 - length(v) / radius;
  if (!(weight > 0.0)) return vec4(0.0);
  vec4 x = vec4(nook_surface_normal(at) - normal, v.z / radius) * weight;
  return nook_texel(nook_filters, 4 * cell) * x.x + nook_texel(nook_filters, 4 * cell + 1) * x.y +
         nook_texel(nook_filters, 4 * cell + 2) * x.z + nook_texel(nook_filters, 4 * cell + 3) * x.w;
}

vec4 nook_paper_sum(ivec2 texel, vec3 position, vec3 normal, vec2 scale, float radius) {
  vec2 noise = nook_tap_noise(texel);
  int taps = nook_tap_groups * NOOK_STEPS;
  vec4 sum = vec4(0.0);
  for (int group = 0; group < nook_tap_groups; ++group)
    for (int i = 0; i < NOOK_STEPS; ++i) {
      int cell = nook_paper_tap_cell(group * NOOK_STEPS + i, taps, noise);
      sum += nook_tap_sum(texel, cell, taps, noise, position, normal, scale, radius);
    }
  return sum * (float(nook_grid_cells) / float(taps));
}

vec4 nook_paper_layer(vec4 x, int first) {
  vec4 sum = nook_network[first + 4] + x.x * nook_network[first] + x.y * nook_network[first + 1] +
             x.z * nook_network[first + 2] + x.w * nook_network[first + 3];
  return nook_prelu(sum, first + 5);
}

float nook_evaluate(ivec2 texel, vec3 position, vec3 normal, vec2 scale, vec2 radius, out vec3 bent) {
  bent = normal;
  vec4 x = nook_prelu(nook_paper_sum(texel, position, normal, scale, radius.x) + nook_network[NOOK_PAPER_FILTERS], NOOK_PAPER_FILTERS + 1);
  x = nook_paper_layer(nook_paper_layer(x, NOOK_PAPER_LAYER_1), NOOK_PAPER_LAYER_2);
  vec4 last = nook_network[NOOK_PAPER_LAYER_3 + 1];  // bias, negative slope, positive slope
  float y = dot(x, nook_network[NOOK_PAPER_LAYER_3]) + last.x;
  return max(y, 0.0) * last.z + min(y, 0.0) * last.y;
}
