// The AO of a texel of the surface by the network, before the blur. The fragment and the compute path share
// this file.
#include "shaders/nnao/depth.glsl"
#include "shaders/nnao/surface.glsl"
#include "shaders/nnao/taps.glsl"
#if NOOK_HORIZON
#include "shaders/nnao/horizon.glsl"
#else
#include "shaders/nnao/paper.glsl"
#endif

float nook_occlusion(ivec2 texel) {
  float depth = nook_surface_depth(texel);
  if (depth == nook_no_surface) return 1.0;
  vec2 scale = nook_pixel_scale(depth);
  return clamp(nook_evaluate(texel, nook_position(nook_surface_rays, texel, depth), nook_surface_normal(texel), scale,
                             nook_pixel_radius(scale)),
               0.0, 1.0);
}
