// The linear layer of OpenGL 3.3: the shadows at key points come in a texture buffer, AO leaves by transform feedback. One
// point a file vertex; its index picks the welded vertex whose attributes it reads.
#include "character/linear.glsl"

layout(location = 0) in float nook_bias;
layout(location = 1) in uvec4 nook_key_points_0;
layout(location = 2) in vec4 nook_alpha_0;
#if NOOK_QUADS > 1
layout(location = 3) in uvec4 nook_key_points_1;
layout(location = 4) in vec4 nook_alpha_1;
#endif

uniform samplerBuffer nook_shadows;  // shadow, added occlusion
uniform int nook_first_texel;        // of the draw's first instance
uniform int nook_key_point_count;
uniform int nook_self;

out float nook_ao;

vec2 nook_blend(uvec4 key_points, vec4 alpha, int first) {
  ivec4 texel = ivec4(key_points) + first;
  return alpha.x * texelFetch(nook_shadows, texel.x).xy + alpha.y * texelFetch(nook_shadows, texel.y).xy +
         alpha.z * texelFetch(nook_shadows, texel.z).xy + alpha.w * texelFetch(nook_shadows, texel.w).xy;
}

void main() {
  int first = nook_first_texel + gl_InstanceID * nook_key_point_count;
  vec2 blended = nook_blend(nook_key_points_0, nook_alpha_0, first);
  float alpha_sum = dot(nook_alpha_0, vec4(1.0));
#if NOOK_QUADS > 1
  blended += nook_blend(nook_key_points_1, nook_alpha_1, first);
  alpha_sum += dot(nook_alpha_1, vec4(1.0));
#endif
  nook_ao = nook_combine(blended.x, blended.y, alpha_sum, nook_self != 0 ? nook_bias : 0.0);
  gl_Position = vec4(0.0);
}
