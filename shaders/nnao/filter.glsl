// A bilateral filter along one axis of the screen. Applied along x and then along y, it averages 7 x 7 texels
// with the weights 1, 3, 6, 7, 6, 3, 1 along each axis. The noise of the taps (taps.glsl) repeats every three
// texels. With these weights, each of its nine values has the same total weight. A texel is only used if
// there is no edge between it and the centre. With more than nine taps, its AO must also be similar.
uniform sampler2D nook_ao;  // AO, edges, and the bent normal in passes that have it

#ifdef NOOK_FILTER_ALONG_Y
const ivec2 nook_filter_step = ivec2(0, 1);
const uint nook_back_bit = 2u, nook_ahead_bit = 0u;
#else
const ivec2 nook_filter_step = ivec2(1, 0);
const uint nook_back_bit = 6u, nook_ahead_bit = 4u;
#endif
// With nine taps, AO is too noisy for a comparison: rows that differ only by noise would not be averaged. The
// filter along x reads texels that are not filtered yet, so it compares them with half the sharpness.
#if NOOK_DIRECTIONS > 3
#ifdef NOOK_FILTER_ALONG_Y
#define NOOK_FILTER_SHARPNESS nook_range_sharpness
#else
#define NOOK_FILTER_SHARPNESS (0.5 * nook_range_sharpness)
#endif
#endif

// Each value of nook_ao contains four edges. Returns one of them, as a number from 0 to 3.
float nook_edge(vec4 texel, uint bit) {
  return float(uint(255.0 * texel.g + 0.5) >> bit & 3u);
}

struct NookFilterSum {
  float ao, weight;
  vec2 bent;
};

void nook_add_texel(inout NookFilterSum sum, vec4 centre, vec4 texel, float weight) {
#ifdef NOOK_FILTER_SHARPNESS
  weight *= clamp(2.0 - NOOK_FILTER_SHARPNESS * abs(texel.r - centre.r), 0.0, 1.0);
#endif
  sum.ao += weight * texel.r;
  sum.weight += weight;
#if NOOK_BENT_NORMALS
  sum.bent += weight * texel.ba;
#endif
}

// Adds the three texels on one side of the centre, in the direction `one`. `last` is the last texel of the
// surface, and `bit` is the place of the edge in this direction.
void nook_add_side(inout NookFilterSum sum, vec4 centre, ivec2 at, ivec2 one, ivec2 last, uint bit) {
  float edge = nook_edge(centre, bit);
  vec4 texel = texelFetch(nook_ao, clamp(at + one, ivec2(0), last), 0);
  nook_add_texel(sum, centre, texel, edge * (6.0 / 7.0 / 3.0));
  edge *= nook_edge(texel, bit);
  texel = texelFetch(nook_ao, clamp(at + 2 * one, ivec2(0), last), 0);
  nook_add_texel(sum, centre, texel, edge * (3.0 / 7.0 / 9.0));
  edge *= nook_edge(texel, bit);
  texel = texelFetch(nook_ao, clamp(at + 3 * one, ivec2(0), last), 0);
  nook_add_texel(sum, centre, texel, edge * (1.0 / 7.0 / 27.0));
}

// Returns a filtered texel. Its edges are not changed.
vec4 nook_filtered(ivec2 texel, ivec2 last) {
  vec4 centre = texelFetch(nook_ao, texel, 0);
  NookFilterSum sum = NookFilterSum(nook_own_weight * centre.r, nook_own_weight, nook_own_weight * centre.ba);
  nook_add_side(sum, centre, texel, -nook_filter_step, last, nook_back_bit);
  nook_add_side(sum, centre, texel, nook_filter_step, last, nook_ahead_bit);
  return vec4(sum.ao / sum.weight, centre.g, sum.bent / sum.weight);
}
