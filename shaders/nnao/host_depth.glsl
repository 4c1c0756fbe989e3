// Converts the host's depth buffer to view-space depth.
#include "shaders/nnao/host_images.glsl"

#ifdef NOOK_SAMPLES
uniform NOOK_HOST_SAMPLES nook_host_depth;
#else
uniform NOOK_HOST_IMAGE nook_host_depth;
#endif

float nook_view_depth(float stored, ivec2 pixel) {
  if ((stored - nook_far_stored) * nook_far_sign >= 0.0) return nook_no_surface;
  stored += dot(nook_stored_slope, vec2(pixel));
  if (nook_log_rate != 0.0) stored = exp2(nook_log_rate * stored);
  float depth = (nook_depth_decode.x + nook_depth_decode.y * stored) /
                (nook_depth_decode.z + nook_depth_decode.w * stored);
  // If depth is NaN, the comparisons are false, and there is no surface.
  return depth > nook_min_depth && depth < nook_no_surface ? depth : nook_no_surface;
}

#ifdef NOOK_SAMPLES
struct NookDepthSample {
  float depth;
  int number;
};

NookDepthSample nook_sample_at(ivec2 pixel, int number) {
  return NookDepthSample(nook_view_depth(nook_host_sample(nook_host_depth, pixel, number).r, pixel), number);
}

// Returns the depth sample that the rule nook_nnao_sample selects. sdk/src/nnao/host_depth.h has the same
// function for the CPU.
NookDepthSample nook_chosen_sample(ivec2 pixel) {
#if NOOK_SAMPLE_RULE == NOOK_SAMPLE_FIRST
  return nook_sample_at(pixel, 0);
#elif NOOK_SAMPLE_RULE == NOOK_SAMPLE_NEAREST
  NookDepthSample nearest = nook_sample_at(pixel, 0);
  for (int i = 1; i < NOOK_SAMPLES; ++i) {
    NookDepthSample other = nook_sample_at(pixel, i);
    if (other.depth < nearest.depth) nearest = other;
  }
  return nearest;
#else
  float depths[NOOK_SAMPLES];
  for (int i = 0; i < NOOK_SAMPLES; ++i) depths[i] = nook_sample_at(pixel, i).depth;
  for (int i = 0; i < NOOK_SAMPLES; ++i) {
    int nearer = 0;
    for (int j = 0; j < NOOK_SAMPLES; ++j) nearer += int(depths[j] < depths[i] || (depths[j] == depths[i] && j < i));
    if (nearer == (NOOK_SAMPLES - 1) / 2) return NookDepthSample(depths[i], i);
  }
  return NookDepthSample(depths[0], 0);
#endif
}

float nook_screen_depth(ivec2 pixel) {
  return nook_chosen_sample(pixel).depth;
}
#else
float nook_screen_depth(ivec2 pixel) {
  return nook_view_depth(nook_host_texel(nook_host_depth, pixel).r, pixel);
}
#endif
