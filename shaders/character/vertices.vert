// The linear layer of OpenGL 3.3: the shadows at key points come in a texture buffer, AO leaves by transform feedback. One
// point a file vertex; its index picks the welded vertex whose attributes it reads.
#include "character/linear.glsl"

layout(location = 0) in float nook_bias;
layout(location = 1) in uvec4 nook_key_points_0;
layout(location = 2) in vec4 nook_alpha_0;
layout(location = 3) in vec4 nook_blend_0;
#if NOOK_QUADS > 1
layout(location = 4) in uvec4 nook_key_points_1;
layout(location = 5) in vec4 nook_alpha_1;
layout(location = 6) in vec4 nook_blend_1;
#endif

uniform samplerBuffer nook_shadows;  // shadow, added occlusion
uniform int nook_first_texel;        // of the draw's first instance
uniform int nook_key_point_count;
uniform int nook_self;

out float nook_ao;

// Shadow and added occlusion of four key points.
vec2 nook_sum(uvec4 key_points, vec4 alpha, vec4 blend, int first) {
  ivec4 texel = ivec4(key_points) + first;
  return vec2(alpha.x, blend.x) * texelFetch(nook_shadows, texel.x).xy +
         vec2(alpha.y, blend.y) * texelFetch(nook_shadows, texel.y).xy +
         vec2(alpha.z, blend.z) * texelFetch(nook_shadows, texel.z).xy +
         vec2(alpha.w, blend.w) * texelFetch(nook_shadows, texel.w).xy;
}

void main() {
  int first = nook_first_texel + gl_InstanceID * nook_key_point_count;
  vec2 sum = nook_sum(nook_key_points_0, nook_alpha_0, nook_blend_0, first);
#if NOOK_QUADS > 1
  sum += nook_sum(nook_key_points_1, nook_alpha_1, nook_blend_1, first);
#endif
  nook_ao = nook_combine(sum.x, sum.y, nook_self != 0 ? nook_bias : 0.0);
  gl_Position = vec4(0.0);
}
