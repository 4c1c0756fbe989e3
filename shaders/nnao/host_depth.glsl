// The host's depth buffer as view-space depth.
#include "shaders/nnao/frame.glsl"

uniform sampler2D nook_host_depth;

float nook_view_depth(float stored) {
  if ((stored - nook_far_stored) * nook_far_sign >= 0.0) return nook_no_surface;
  if (nook_log_rate != 0.0) stored = exp2(nook_log_rate * stored);
  float depth = (nook_depth_decode.x + nook_depth_decode.y * stored) /
                (nook_depth_decode.z + nook_depth_decode.w * stored);
  // Comparisons with NaN are false.
  return depth > nook_min_depth && depth < nook_no_surface ? depth : nook_no_surface;
}

float nook_screen_depth(ivec2 pixel) {
  return nook_view_depth(texelFetch(nook_host_depth, pixel + nook_origin, 0).r);
}
