// Converts the AO of a pixel to the output of a pass: applies intensity and power, and combines AO with the
// host's G-buffer AO.
#include "shaders/nnao/host_images.glsl"

#ifdef NOOK_LAYERED
uniform NOOK_HOST_IMAGE nook_layer;
#endif

float nook_strengthened(float ao) {
  float base = max(1.0 - nook_intensity * (1.0 - ao), 0.0);
  // pow is inexact on some drivers, but an AO of 1 must remain exactly 1.
  return nook_power == 1.0 || base == 1.0 ? base : pow(base, nook_power);
}

#ifdef NOOK_LAYERED
// Combines AO with the host's layer. nook_gbuffer_ao describes the modes.
float nook_combined(float ao, ivec2 pixel) {
  vec2 layer = nook_host_texel(nook_layer, pixel).rg;
  if (nook_layer_mode >= NOOK_LAYER_REPLACE) return mix(ao, layer.r, layer.g);
  float smaller = min(ao, layer.r);
  return nook_layer_mode == NOOK_LAYER_MIN ? smaller : layer.r > 0.0 ? smaller / layer.r : 1.0;
}
#endif
