// Shows the normals that the network uses, as (n + 1) / 2. Pixels without a surface are black.
#include "shaders/nnao/normal.glsl"

out vec4 nook_out;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy) - nook_origin;
#if NOOK_HALF
  texel /= 2;
#endif
  float depth = nook_depth_at(texel);
  vec3 normal = depth == nook_no_surface ? vec3(0.0) : nook_texel_normal(texel, nook_neighbours_of(texel, depth));
  nook_out = vec4(0.5 * normal + 0.5, 1.0);
}
