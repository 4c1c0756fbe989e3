// Averages the AO of a frame with the mean of the previous frames. The position of a texel's surface in the
// earlier frame is computed from the camera matrices and the host's motion vectors. Of the four texels around
// this position, only the texels that show the same surface are used. sdk/src/nnao/history.h has the same
// functions for the CPU.
#include "shaders/nnao/depth.glsl"
#include "shaders/nnao/host_images.glsl"

uniform sampler2D nook_ao;              // AO and edges of this frame
uniform sampler2D nook_history;         // AO (see nook_packed), edges, the remainder of AO, number of frames in the mean
uniform usampler2D nook_history_depth;  // like nook_depth, for the earlier frame
uniform NOOK_HOST_IMAGE nook_motion;          // the host's motion vectors
uniform vec4 nook_earlier[NOOK_EARLIER_VEC4S];

out vec4 nook_out;

#define nook_earlier_rays nook_earlier[NOOK_EARLIER_RAYS]   // like nook_surface_rays, for the earlier frame
#define nook_earlier_last nook_earlier[NOOK_EARLIER_SIZE].xy  // texel of the earlier surface's upper right corner
#define nook_max_frames nook_earlier[NOOK_EARLIER_SIZE].z    // maximum number of frames in the mean; 1: the history is ignored
#define nook_has_motion (nook_earlier[NOOK_EARLIER_SIZE].w != 0.0)
#define nook_motion_scale nook_earlier[NOOK_EARLIER_MOTION].xy  // texels of the surface per unit of the motion texture
#define nook_noise_reach nook_earlier[NOOK_EARLIER_MOTION].z    // the approximate amplitude of the noise that
                                                                // the taps cause in AO

// Splits AO in [0, 1] into the nearest 255th, which the filter reads, and the remainder. Both parts together
// have enough precision for a mean over many frames. With only 8 bits, the mean would stop changing.
vec4 nook_packed(float ao, float edges, float frames) {
  float step = floor(255.0 * ao + 0.5);
  return vec4(step, 255.0 * edges, floor(127.5 + 254.0 * (255.0 * ao - step)), frames) / 255.0;
}

float nook_unpacked(vec4 texel) {
  return texel.r + (255.0 * texel.b - 127.0) / (254.0 * 255.0);
}

vec3 nook_earlier_position(vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(nook_earlier[0], p), dot(nook_earlier[1], p), dot(nook_earlier[2], p));
}

// Returns the smaller of the two changes of depth to the neighbours along an axis.
float nook_flat_step(float depth, float before, float after) {
  return min(abs(before - depth), abs(after - depth));
}

// Returns the range to which earlier AO is clamped. It is the mean of the texels that the edges connect, plus
// and minus twice their standard deviation (at least 0.06). It is also limited to the texel's own AO plus and
// minus the noise of the taps, which preserves thin lines. The clamp prevents trails behind moving objects.
vec2 nook_likely_range(ivec2 texel, vec2 centre) {
  ivec2 low = max(texel - 1, ivec2(0)), high = min(texel + 1, nook_surface_size - 1);
  uint bits = uint(255.0 * centre.g + 0.5);
  vec4 weights = vec4(bits >> 6u, bits >> 4u & 3u, bits >> 2u & 3u, bits & 3u) / 3.0;
  vec4 around = vec4(texelFetch(nook_ao, ivec2(low.x, texel.y), 0).r, texelFetch(nook_ao, ivec2(high.x, texel.y), 0).r,
                     texelFetch(nook_ao, ivec2(texel.x, low.y), 0).r, texelFetch(nook_ao, ivec2(texel.x, high.y), 0).r);
  float sum = 1.0 + dot(weights, vec4(1.0));
  float mean = (centre.r + dot(weights, around)) / sum;
  float deviation = sqrt(max((centre.r * centre.r + dot(weights, around * around)) / sum - mean * mean, 0.0));
  float reach = max(2.0 * deviation, 0.06);
  return vec2(max(mean - reach, centre.r - nook_noise_reach), min(mean + reach, centre.r + nook_noise_reach));
}

// Returns the mean AO of earlier frames, and the number of frames in this mean. The number is 0 if the surface
// was not visible.
vec2 nook_earlier_ao(ivec2 texel, float depth) {
  vec3 earlier = nook_earlier_position(nook_position(nook_surface_rays, vec2(texel), depth));
  vec2 place = (earlier.xy / nook_extent(-earlier.z) - nook_earlier_rays.yw) / nook_earlier_rays.xz;
  if (nook_has_motion) {
#if NOOK_HALF
    ivec2 pixel = 2 * texel;
#else
    ivec2 pixel = texel;
#endif
    place = vec2(texel) - nook_motion_scale * nook_host_texel(nook_motion, pixel).rg;
  }
  // This also returns for NaN, because comparisons with NaN are false.
  if (!(all(greaterThan(place, vec2(-1.0))) && all(lessThan(place, nook_earlier_last + 1.0)))) return vec2(0.0);
  float slope = nook_flat_step(depth, nook_depth_near(texel - ivec2(1, 0)), nook_depth_near(texel + ivec2(1, 0))) +
                nook_flat_step(depth, nook_depth_near(texel - ivec2(0, 1)), nook_depth_near(texel + ivec2(0, 1)));
  float tolerance = slope + 2.0 * nook_extent(depth) / nook_edge_scale(depth) + 0.002 * depth;
  vec2 base = floor(place), share = place - base;
  vec2 sums = vec2(0.0);
  float total = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    vec2 aside = vec2(corner & 1, corner >> 1), at = base + aside;
    if (at != clamp(at, vec2(0.0), nook_earlier_last)) continue;
    float stored = uintBitsToFloat(texelFetch(nook_history_depth, ivec2(at), 0).r);
    if (!(abs(stored + earlier.z) < tolerance)) continue;
    vec4 history = texelFetch(nook_history, ivec2(at), 0);
    vec2 near = mix(1.0 - share, share, aside);
    float weight = near.x * near.y * step(0.5 / 255.0, history.a);
    sums += weight * vec2(nook_unpacked(history), 255.0 * history.a);
    total += weight;
  }
  return total > 0.05 ? sums / total : vec2(0.0);
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float depth = nook_depth_at(texel);
  vec2 current = texelFetch(nook_ao, texel, 0).rg;
  if (depth == nook_no_surface) {
    nook_out = nook_packed(1.0, current.g, 0.0);
    return;
  }
  vec2 earlier = nook_max_frames > 1.0 ? nook_earlier_ao(texel, depth) : vec2(0.0);
  float frames = min(floor(earlier.y + 0.5) + 1.0, nook_max_frames);
  vec2 range = nook_likely_range(texel, current);
  float ao = mix(clamp(earlier.x, range.x, range.y), current.r, 1.0 / frames);
  nook_out = nook_packed(clamp(ao, 0.0, 1.0), current.g, frames);
}
