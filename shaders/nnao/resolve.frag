// Computes the output from the AO of the surface: the blur's second axis or the upsample, the layer, the
// view.
#include "shaders/nnao/depth.glsl"
#include "shaders/nnao/surface.glsl"
#include "shaders/nnao/blur.glsl"

uniform sampler2D nook_layer;

out vec4 nook_out;

#if NOOK_HALF
// Joint-bilateral upsample: the result is over those of the four texels around the pixel whose plane contains
// the pixel, or the one with the nearest plane if there is none.
float nook_upsampled(ivec2 pixel, float depth) {
  vec3 position = nook_position(nook_screen_rays, pixel, depth);
  float tolerance = nook_pixel_radius(nook_pixel_scale(depth)).x / nook_blur_sharpness;
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    ivec2 at = pixel / 2 + corner;
    float at_depth = nook_surface_depth(at);
    if (at_depth == nook_no_surface) continue;
    vec2 lerp = 1.0 - 0.5 * abs(vec2(2 * at - pixel));
    vec3 away = position - nook_position(nook_surface_rays, at, at_depth);
    float off_plane = dot(away, nook_surface_normal(at)) / tolerance;
    float weight = (lerp.x * lerp.y + 1.0e-3) / (1.0e-3 + off_plane * off_plane);
    sum += weight * nook_ao_at(at);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 1.0;
}
#endif

float nook_screen_ao(ivec2 pixel) {
  float depth = nook_screen_depth(pixel);
  if (depth == nook_no_surface) return 1.0;
#if NOOK_HALF
  return nook_upsampled(pixel, depth);
#else
  return nook_blurred(pixel);
#endif
}

vec3 nook_shown_normal(ivec2 pixel) {
#if NOOK_HALF
  ivec2 texel = pixel / 2;
#else
  ivec2 texel = pixel;
#endif
  return nook_surface_depth(texel) == nook_no_surface ? vec3(0.0) : nook_surface_normal(texel);
}

float nook_strengthened(float ao) {
  float base = max(1.0 - nook_intensity * (1.0 - ao), 0.0);
  // pow is inexact on some drivers, and open must stay exactly open.
  return nook_power == 1.0 || base == 1.0 ? base : pow(base, nook_power);
}

// The modes of nook_nnao_layer.
float nook_combined(float ao, ivec2 pixel) {
  if (nook_layer_mode == 0) return ao;
  vec2 layer = texelFetch(nook_layer, pixel + nook_origin, 0).rg;
  if (nook_layer_mode == 3) return mix(ao, layer.r, layer.g);
  float least = min(ao, layer.r);
  return nook_layer_mode == 1 ? least : layer.r > 0.0 ? least / layer.r : 1.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  if (nook_view_mode == 3) {
    nook_out = vec4(0.5 * nook_shown_normal(pixel) + 0.5, 1.0);
    return;
  }
  float ao = nook_screen_ao(pixel);
  if (nook_view_mode == 0) ao = nook_combined(nook_strengthened(ao), pixel);
  nook_out = vec4(vec3(ao), 1.0);
}
