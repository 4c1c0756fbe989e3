// Upsamples with a joint bilateral filter. The AO of a pixel is the weighted mean of the four texels of the
// half-size surface around it. The weight of a texel depends on how close it is to the pixel's plane.
#include "shaders/nnao/depth.glsl"

uniform sampler2D nook_ao;
// The value of nook_ao where there is no surface.
#ifndef NOOK_OPEN_TEXEL
#define NOOK_OPEN_TEXEL vec4(1.0, 0.0, vec2(128.0 / 255.0))
#endif
const vec4 nook_open = NOOK_OPEN_TEXEL;

float nook_smaller(float a, float b) {
  return abs(a) < abs(b) ? a : b;
}

#ifdef NOOK_GATHERS
uniform vec2 nook_texel_size;  // the inverse of the size of nook_depth and nook_ao, in texels

// Reads four texels with one lookup per texture: `low`, the texel on its right, and the two texels above
// these. Only the red channel of nook_ao is read, unless its texels are colours.
void nook_fetch_quad(ivec2 low, out vec4 depths, out mat4 values) {
  vec2 middle = vec2(low + 1) * nook_texel_size;
  depths = uintBitsToFloat(textureGather(nook_depth, middle).wzxy);
  // If the surface is only one texel wide along an axis, there is no second texel along this axis.
  bvec2 lone = lessThan(nook_surface_size, ivec2(2));
  if (lone.x) depths.yw = vec2(nook_no_surface);
  if (lone.y) depths.zw = vec2(nook_no_surface);
  vec4 red = textureGather(nook_ao, middle).wzxy;
#ifdef NOOK_COLOURED
  values = transpose(mat4(red, textureGather(nook_ao, middle, 1).wzxy, textureGather(nook_ao, middle, 2).wzxy,
                          textureGather(nook_ao, middle, 3).wzxy));
#else
  values = mat4(vec4(red.x), vec4(red.y), vec4(red.z), vec4(red.w));
#endif
}
#else
void nook_fetch_quad(ivec2 low, out vec4 depths, out mat4 values) {
  ivec2 high = min(low + 1, nook_surface_size - 1);
  ivec2 texels[4] = ivec2[4](low, ivec2(high.x, low.y), ivec2(low.x, high.y), high);
  depths = vec4(nook_depth_at(texels[0]), nook_depth_at(texels[1]), nook_depth_at(texels[2]), nook_depth_at(texels[3]));
  values = mat4(texelFetch(nook_ao, texels[0], 0), texelFetch(nook_ao, texels[1], 0), texelFetch(nook_ao, texels[2], 0),
                texelFetch(nook_ao, texels[3], 0));
}
#endif

#ifdef NOOK_LAYERED
// Among the texels around the four, returns the value of the texel whose depth is closest to `depth`.
vec4 nook_value_around(ivec2 low, float depth) {
  vec4 found = nook_open;
  float least = nook_no_surface;
  for (int i = 0; i < 16; ++i) {
    ivec2 texel = low + ivec2(i & 3, i >> 2) - 1;
    if (!nook_inside(texel, nook_surface_size)) continue;
    float off = abs(nook_depth_at(texel) - depth);
    if (off < least) found = texelFetch(nook_ao, texel, 0);
    least = min(least, off);
  }
  return found;
}
#endif

// Returns an upsampled value of nook_ao. The edges in the result are meaningless.
vec4 nook_upsampled(ivec2 pixel, float depth) {
  ivec2 low = pixel / 2;
#ifdef NOOK_GATHERS
  // Moves the quad so that all four texels are inside the surface. The pixel may then be outside the quad.
  low = max(min(low, nook_surface_size - 2), ivec2(0));
#endif
  vec4 depths;
  mat4 values;
  nook_fetch_quad(low, depths, values);
  // On a plane, this difference is a linear function of the position in pixels.
  vec4 rise = (depths - depth) / (nook_spread.x * depths + nook_spread.y);
  vec2 slope = vec2(nook_smaller(rise.y - rise.x, rise.w - rise.z), nook_smaller(rise.z - rise.x, rise.w - rise.y));
  vec2 place = 0.5 * vec2(pixel - 2 * low);  // the pixel's position in texels, relative to the lower left
                                             // texel
  vec4 plane = vec4(0.0, slope.x, slope.y, slope.x + slope.y) - dot(slope, place);
  vec4 off = (rise - plane) * nook_edge_scale(depth);
#ifdef NOOK_GATHERS
  place = min(place, vec2(1.0));
#endif
  vec4 lerp = vec4(1.0 - place.x, place.x, 1.0 - place.x, place.x) * vec4(1.0 - place.y, 1.0 - place.y, place.y, place.y);
  vec4 weights = (lerp + 1.0e-3) / (1.0e-3 + off * off);
  weights *= vec4(notEqual(depths, vec4(nook_no_surface)));
  float sum = dot(weights, vec4(1.0));
#ifdef NOOK_LAYERED
  // All four weights can be 0, for example for the floor beside a foot, if the layer excludes the foot.
  if (sum == 0.0 && nook_layer_mode >= NOOK_LAYER_REPLACE) return nook_value_around(low, depth);
#endif
  return sum > 0.0 ? values * weights / sum : nook_open;
}
