// Writes the depth of the surface: the linear depth of every pixel, or of every second pixel of every second
// row. The later stages read it many times, and the host's depth costs a division each time.
#include "shaders/nnao/host_depth.glsl"

out uint nook_out;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if NOOK_HALF
  texel *= 2;
#endif
  nook_out = floatBitsToUint(nook_screen_depth(texel));
}
