// A bilateral filter along one axis of the screen. Applied along x and then along y, it averages 5 x 5 texels
// with the weights 1, 2, 3, 2, 1 along each axis. The noise of the taps repeats every three texels. With
// these weights, all values of the noise have the same total weight. A texel is only used if there is no edge
// between it and the centre, and if its AO is similar.
uniform sampler2D nook_ao;  // AO, edges, and the bent normal in passes that have it

#ifdef NOOK_FILTER_ALONG_Y
const ivec2 nook_filter_step = ivec2(0, 1);
const uint nook_back_bit = 2u, nook_ahead_bit = 0u;
#else
const ivec2 nook_filter_step = ivec2(1, 0);
const uint nook_back_bit = 6u, nook_ahead_bit = 4u;
#endif
// The filter along x reads texels that are not filtered yet. With nine taps, their AO is too noisy to be
// compared. With more taps, it is compared with half the sharpness.
#ifdef NOOK_FILTER_ALONG_Y
#define NOOK_FILTER_SHARPNESS nook_range_sharpness
#elif NOOK_DIRECTIONS > 3
#define NOOK_FILTER_SHARPNESS (0.5 * nook_range_sharpness)
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

// Adds the two texels on one side of the centre. `edge` is the centre's edge towards them, 0 to 3.
void nook_add_side(inout NookFilterSum sum, vec4 centre, float edge, ivec2 near, ivec2 far, uint bit) {
  vec4 texel = texelFetch(nook_ao, near, 0);
  nook_add_texel(sum, centre, texel, edge * (2.0 / 9.0));
  nook_add_texel(sum, centre, texelFetch(nook_ao, far, 0), edge * nook_edge(texel, bit) * (1.0 / 27.0));
}

// Returns a filtered texel. Its edges are not changed.
vec4 nook_filtered(ivec2 texel, ivec2 last) {
  ivec2 one = nook_filter_step, two = 2 * nook_filter_step;
  vec4 centre = texelFetch(nook_ao, texel, 0);
  NookFilterSum sum = NookFilterSum(nook_own_weight * centre.r, nook_own_weight, nook_own_weight * centre.ba);
  nook_add_side(sum, centre, nook_edge(centre, nook_back_bit), max(texel - one, ivec2(0)), max(texel - two, ivec2(0)),
                nook_back_bit);
  nook_add_side(sum, centre, nook_edge(centre, nook_ahead_bit), min(texel + one, last), min(texel + two, last),
                nook_ahead_bit);
  return vec4(sum.ao / sum.weight, centre.g, sum.bent / sum.weight);
}
