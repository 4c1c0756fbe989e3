// Draws only the pixels of one question of SurfaceWatch. A query then counts them.
#include "shaders/nnao/host_depth.glsl"

uniform NOOK_HOST_IMAGE nook_layer;
uniform int nook_question;

// A pass that excludes surfaces defines its own limit. Other passes use the limit of layers that replace AO.
#ifndef NOOK_NO_SURFACE_ABOVE
#define NOOK_NO_SURFACE_ABOVE NOOK_REPLACED_ABOVE
#endif

out vec4 nook_out;

bool nook_is_counted(ivec2 pixel, float depth) {
  if (nook_question == NOOK_WATCH_UNMASKED) {
    float limit = nook_layer_mode > NOOK_LAYER_REPLACE ? NOOK_NO_SURFACE_ABOVE : NOOK_REPLACED_ABOVE;
    return nook_host_texel(nook_layer, pixel).g <= limit;
  }
  float radius_px = nook_radius / abs(nook_screen_rays.z * nook_extent(depth));
  if (nook_question == NOOK_WATCH_FAR_ENOUGH) return radius_px <= float(nook_screen_size.y);
  if (nook_question == NOOK_WATCH_NEAR_ENOUGH) return radius_px >= 2.0;
  return true;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  float depth = nook_screen_depth(pixel);
  if (depth == nook_no_surface || !nook_is_counted(pixel, depth)) discard;
  nook_out = vec4(0.0);
}
