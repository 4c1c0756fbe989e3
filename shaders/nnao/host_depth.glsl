// The host's depth buffer as view-space depth.
#include "shaders/nnao/host_images.glsl"

#ifdef NOOK_SAMPLES
uniform sampler2DMS nook_host_depth;
#else
uniform NOOK_HOST_IMAGE nook_host_depth;
#endif

float nook_view_depth(float stored) {
  if ((stored - nook_far_stored) * nook_far_sign >= 0.0) return nook_no_surface;
  if (nook_log_rate != 0.0) stored = exp2(nook_log_rate * stored);
  float depth = (nook_depth_decode.x + nook_depth_decode.y * stored) /
                (nook_depth_decode.z + nook_depth_decode.w * stored);
  // Comparisons with NaN are false.
  return depth > nook_min_depth && depth < nook_no_surface ? depth : nook_no_surface;
}

#ifdef NOOK_SAMPLES
float nook_sample_depth(ivec2 pixel, int number) {
  return nook_view_depth(texelFetch(nook_host_depth, pixel + nook_origin, number).r);
}

// Returns the depth of one sample, as nook_nnao_sample says.
float nook_screen_depth(ivec2 pixel) {
#if NOOK_SAMPLE_RULE == NOOK_SAMPLE_FIRST
  return nook_sample_depth(pixel, 0);
#elif NOOK_SAMPLE_RULE == NOOK_SAMPLE_NEAREST
  float nearest = nook_no_surface;
  for (int i = 0; i < NOOK_SAMPLES; ++i) nearest = min(nearest, nook_sample_depth(pixel, i));
  return nearest;
#else
  float depths[NOOK_SAMPLES];
  for (int i = 0; i < NOOK_SAMPLES; ++i) depths[i] = nook_sample_depth(pixel, i);
  for (int i = 0; i < NOOK_SAMPLES; ++i) {
    int nearer = 0;
    for (int j = 0; j < NOOK_SAMPLES; ++j) nearer += int(depths[j] < depths[i] || (depths[j] == depths[i] && j < i));
    if (nearer == (NOOK_SAMPLES - 1) / 2) return depths[i];
  }
  return depths[0];
#endif
}
#else
float nook_screen_depth(ivec2 pixel) {
  return nook_view_depth(nook_host_texel(nook_host_depth, pixel).r);
}
#endif
