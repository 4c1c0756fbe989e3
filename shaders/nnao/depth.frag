// Writes the linear depth of the surface, for every pixel or for every second pixel of every second row.
// Decoding the host's depth takes a division. Later stages read depth many times, so it is decoded here once.
#include "shaders/nnao/host_depth.glsl"

// NOOK_NO_SURFACE_ABOVE is a threshold. Where the weight of the host's layer is above it, there is no surface.
#ifdef NOOK_NO_SURFACE_ABOVE
uniform NOOK_HOST_IMAGE nook_layer;
#endif

#ifdef NOOK_NORMAL_SAMPLES
out uvec2 nook_out;  // depth and the index of its sample; the next stage reads the normal of this sample
#else
out uint nook_out;
#endif

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if NOOK_HALF
  texel *= 2;
#endif
#ifdef NOOK_NORMAL_SAMPLES
  NookDepthSample chosen = nook_chosen_sample(texel);
  float depth = chosen.depth;
#else
  float depth = nook_screen_depth(texel);
#endif
#ifdef NOOK_NO_SURFACE_ABOVE
  if (nook_host_texel(nook_layer, texel).g > NOOK_NO_SURFACE_ABOVE) depth = nook_no_surface;
#endif
#ifdef NOOK_NORMAL_SAMPLES
  nook_out = uvec2(floatBitsToUint(depth), chosen.number);
#else
  nook_out = floatBitsToUint(depth);
#endif
}
