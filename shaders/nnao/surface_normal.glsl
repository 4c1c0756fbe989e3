// Reads the normals of the surface that normals.frag has written.
#include "shaders/nnao/octahedral.glsl"

#if defined(GL_ES)
uniform usampler2D nook_normal;  // 16-bit numbers
#else
uniform sampler2D nook_normal;
#endif

vec3 nook_surface_normal(ivec2 texel) {
#if defined(GL_ES)
  return nook_from_octahedral(vec2(texelFetch(nook_normal, texel, 0).rg) / 65535.0);
#else
  return nook_from_octahedral(texelFetch(nook_normal, texel, 0).rg);
#endif
}
