// Draws only the pixels of one question of SurfaceWatch. A query then counts them.
#include "shaders/nnao/host_depth.glsl"

uniform NOOK_HOST_IMAGE nook_layer;
uniform int nook_question;

// A pass that excludes surfaces defines its own limit. Other passes use the limit of layers that replace AO.
#ifndef NOOK_NO_SURFACE_ABOVE
#define NOOK_NO_SURFACE_ABOVE NOOK_REPLACED_ABOVE
#endif

out vec4 nook_out;

bool nook_is_far_enough(float radius_px) {
  return radius_px <= float(nook_screen_size.y);
}
bool nook_is_near_enough(float radius_px) {
  return radius_px >= 2.0;
}
float nook_watched_radius_px(float depth) {
  return nook_radius / abs(nook_screen_rays.z * nook_extent(depth));
}

// For depth with samples, the first sample is enough.
float nook_reversed_depth(ivec2 pixel) {
#ifdef NOOK_SAMPLES
  float stored = nook_host_sample(nook_host_depth, pixel, 0).r;
#else
  float stored = nook_host_texel(nook_host_depth, pixel).r;
#endif
  return nook_view_depth(1.0 - stored, pixel);
}

bool nook_is_counted(ivec2 pixel, float depth) {
  if (nook_question == NOOK_WATCH_UNMASKED) {
    float limit = nook_layer_mode > NOOK_LAYER_REPLACE ? NOOK_NO_SURFACE_ABOVE : NOOK_REPLACED_ABOVE;
    return nook_host_texel(nook_layer, pixel).g <= limit;
  }
  if (nook_question == NOOK_WATCH_REVERSED) {
    float reversed = nook_reversed_depth(pixel), reversed_px = nook_watched_radius_px(reversed);
    return reversed != nook_no_surface && nook_is_far_enough(reversed_px) && nook_is_near_enough(reversed_px);
  }
  float radius_px = nook_watched_radius_px(depth);
  if (nook_question == NOOK_WATCH_FAR_ENOUGH) return nook_is_far_enough(radius_px);
  if (nook_question == NOOK_WATCH_NEAR_ENOUGH) return nook_is_near_enough(radius_px);
  return true;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  float depth = nook_screen_depth(pixel);
  if (depth == nook_no_surface || !nook_is_counted(pixel, depth)) discard;
  nook_out = vec4(0.0);
}
