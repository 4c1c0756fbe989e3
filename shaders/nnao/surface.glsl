// Depth and normal of the surface's texels. At full resolution depth stays in the host's buffer.
#include "shaders/nnao/octahedral.glsl"

#if NOOK_HALF
uniform usampler2D nook_surface;  // depth as a float's bits, normal as 2 x 16 bits
#elif defined(GL_ES)
uniform usampler2D nook_surface;  // normal as 16-bit numbers
#else
uniform sampler2D nook_surface;  // normal
#endif

uniform ivec2 nook_ao_origin;  // the place of the surface's first texel in the texture of its AO

float nook_surface_depth(ivec2 texel) {
#if NOOK_HALF
  return nook_inside(texel, nook_surface_size) ? uintBitsToFloat(texelFetch(nook_surface, texel, 0).r)
                                               : nook_no_surface;
#else
  return nook_screen_depth(texel);
#endif
}

vec3 nook_surface_normal(ivec2 texel) {
#if NOOK_HALF
  uint bits = texelFetch(nook_surface, texel, 0).g;
  return nook_from_octahedral(vec2(bits & 0xffffu, bits >> 16) / 65535.0);
#elif defined(GL_ES)
  return nook_from_octahedral(vec2(texelFetch(nook_surface, texel, 0).rg) / 65535.0);
#else
  return nook_from_octahedral(texelFetch(nook_surface, texel, 0).rg);
#endif
}
