// Computes the output from the AO of the surface. It filters or upsamples AO, applies intensity and power, and
// combines AO with the host's layer.
#include "shaders/nnao/output.glsl"
#if NOOK_HALF
#include "shaders/nnao/host_depth.glsl"
#include "shaders/nnao/upsample.glsl"
#else
#define NOOK_FILTER_ALONG_Y 1
#include "shaders/nnao/filter.glsl"
#endif
#if NOOK_BENT_NORMALS
#include "shaders/nnao/bent_normal.glsl"
#endif

out vec4 nook_out;

// Returns AO in red, and the encoded bent normal in blue and alpha.
vec4 nook_screen_value(ivec2 pixel) {
#if NOOK_HALF
  float depth = nook_screen_depth(pixel);
  return depth == nook_no_surface ? nook_open : nook_upsampled(pixel, depth);
#else
  return nook_filtered(pixel, nook_screen_size - 1);
#endif
}

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
