// Writes the depth of the surface: the linear depth of every pixel, or of every second pixel of every second
// row. The later stages read it many times, and the host's depth costs a division each time.
#include "shaders/nnao/host_depth.glsl"

// NOOK_APART: the weight of the layer above which there is no surface.
#ifdef NOOK_APART
uniform NOOK_HOST_IMAGE nook_layer;
#endif

out uint nook_out;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if NOOK_HALF
  texel *= 2;
#endif
  float depth = nook_screen_depth(texel);
#ifdef NOOK_APART
  if (nook_host_texel(nook_layer, texel).g > NOOK_APART) depth = nook_no_surface;
#endif
  nook_out = floatBitsToUint(depth);
}
