// Draws a pixel at full resolution, or a texel of a stage at half resolution.
#include "shaders/nnao/host_depth.glsl"
#if !NOOK_HALF
#include "shaders/world/output.glsl"
#endif
#include "shaders/world/darken.glsl"

out vec4 nook_out;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if NOOK_BODIES == NOOK_FAR_BODIES
  ivec2 pixel = NOOK_FAR_STEP * texel;
#elif NOOK_HALF
  ivec2 pixel = 2 * texel;
#else
  ivec2 pixel = texel - nook_origin;
#endif
  NookSurface surface = nook_world_surface(pixel);
  float open = surface.there ? nook_world_list_open(nook_world_first_tile, pixel, surface.position, surface.normal) : 1.0;
  vec4 light = nook_world_light(pixel, surface, open);
#if NOOK_HALF
  nook_out = light;
#else
  nook_out = nook_world_counts == 0 ? nook_world_result(light, pixel) : light;
#endif
}
