// Writes the normals of the surface for the paper's form, which reads them at its taps.
#include "shaders/nnao/normal.glsl"
#include "shaders/nnao/octahedral.glsl"

#if defined(GL_ES)
out uvec2 nook_out;
#else
out vec2 nook_out;
#endif

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float depth = nook_depth_at(texel);
  vec2 normal = vec2(0.5);
  if (depth != nook_no_surface) normal = nook_octahedral(nook_texel_normal(texel, nook_neighbours_of(texel, depth)));
#if defined(GL_ES)
  nook_out = uvec2(normal * 65535.0 + 0.5);  // integers, because OpenGL ES cannot draw into normalised 16-bit formats
#else
  nook_out = normal;
#endif
}
