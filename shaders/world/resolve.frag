// Upsamples AO, which was computed for every second pixel of every second row, to all pixels, and computes
// the result. With NOOK_COUNTS, the texels are counters, which are not interpolated.
#include "shaders/nnao/host_depth.glsl"
#ifdef NOOK_COLOURED
#define NOOK_OPEN_TEXEL vec4(1.0)
#endif
#include "shaders/nnao/upsample.glsl"
#include "shaders/world/output.glsl"

out vec4 nook_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
#ifdef NOOK_COUNTS
  nook_out = vec4(texelFetch(nook_ao, pixel / 2, 0).rrr, 1.0);
#else
  float depth = nook_screen_depth(pixel);
  vec4 light = depth == nook_no_surface ? vec4(1.0) : nook_upsampled(pixel, depth);
#ifndef NOOK_COLOURED
  light = vec4(light.rrr, 1.0);
#endif
  nook_out = nook_world_result(light, pixel);
#endif
}
