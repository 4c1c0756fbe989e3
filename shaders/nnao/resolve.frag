// Computes the output from the AO of the surface: the filter or the upsample, strength, the layer.
#include "shaders/nnao/host_images.glsl"
#if NOOK_HALF
#include "shaders/nnao/host_depth.glsl"
#include "shaders/nnao/upsample.glsl"
#else
#include "shaders/nnao/filter.glsl"
#endif
#if NOOK_BENT_NORMALS
#include "shaders/nnao/bent_normal.glsl"
#endif

#ifdef NOOK_LAYERED
uniform NOOK_HOST_IMAGE nook_layer;
#endif

out vec4 nook_out;

// Returns AO, and the bent normal in blue and alpha.
vec4 nook_screen_value(ivec2 pixel) {
#if NOOK_HALF
  float depth = nook_screen_depth(pixel);
  return depth == nook_no_surface ? nook_open : nook_upsampled(pixel, depth);
#else
  return nook_filtered(pixel, nook_screen_size - 1);
#endif
}

float nook_strengthened(float ao) {
  float base = max(1.0 - nook_intensity * (1.0 - ao), 0.0);
  // pow is inexact on some drivers, and open must stay exactly open.
  return nook_power == 1.0 || base == 1.0 ? base : pow(base, nook_power);
}

#ifdef NOOK_LAYERED
// The modes of nook_gbuffer_ao.
float nook_combined(float ao, ivec2 pixel) {
  vec2 layer = nook_host_texel(nook_layer, pixel).rg;
  if (nook_layer_mode >= 3) return mix(ao, layer.r, layer.g);
  float smaller = min(ao, layer.r);
  return nook_layer_mode == 1 ? smaller : layer.r > 0.0 ? smaller / layer.r : 1.0;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  vec4 value = nook_screen_value(pixel);
  float ao = nook_strengthened(value.r);
#ifdef NOOK_LAYERED
  ao = nook_combined(ao, pixel);
#endif
  nook_out = vec4(vec3(ao), 1.0);
#if NOOK_BENT_NORMALS
  if (nook_writes_bent_normals) nook_out = vec4(0.5 * nook_decoded_bent_normal(value.ba, pixel) + 0.5, ao);
#endif
}
