// AO of every texel of the surface by the network, not yet blurred.
#include "nnao/depth.glsl"
#include "nnao/surface.glsl"
#include "nnao/taps.glsl"
#if NOOK_HORIZON
#include "nnao/horizon.glsl"
#else
#include "nnao/paper.glsl"
#endif

out float nook_out;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float depth = nook_surface_depth(texel);
  nook_out = 1.0;
  if (depth == nook_no_surface) return;
  vec2 scale = nook_pixel_scale(depth);
  nook_out = clamp(nook_evaluate(texel, nook_position(nook_surface_rays, texel, depth), nook_surface_normal(texel),
                                 scale, nook_pixel_radius(scale)),
                   0.0, 1.0);
}
