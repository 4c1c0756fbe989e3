// The linear layer for OpenGL 3.3. It reads the shadows at key points from a texture buffer, and writes AO by
// transform feedback. Each file vertex is drawn as one point. Its index selects the welded vertex, whose
// attributes the shader reads.
#include "shaders/character/layout.h"
#include "shaders/character/linear.glsl"
#include "shaders/core/texels.glsl"

layout(location = NOOK_ATTRIBUTE_BIAS) in float nook_bias;
layout(location = NOOK_ATTRIBUTE_KEY_POINTS_0) in uvec4 nook_key_points_0;
layout(location = NOOK_ATTRIBUTE_ALPHA_0) in vec4 nook_alpha_0;
layout(location = NOOK_ATTRIBUTE_BLEND_0) in vec4 nook_blend_0;
#if NOOK_QUADS > 1
layout(location = NOOK_ATTRIBUTE_KEY_POINTS_1) in uvec4 nook_key_points_1;
layout(location = NOOK_ATTRIBUTE_ALPHA_1) in vec4 nook_alpha_1;
layout(location = NOOK_ATTRIBUTE_BLEND_1) in vec4 nook_blend_1;
#endif

// One texel holds shadow and added occlusion. With NOOK_LIGHT, a key point has two texels: coloured shadow
// and shadow; added occlusion.
uniform NOOK_TEXELS nook_shadows;
uniform int nook_first_key_point;    // index within the page of the first key point of the draw's first
                                     // instance
uniform int nook_key_point_count;
uniform int nook_self;
uniform float nook_hidden;           // share of the AO that is hidden while the instances fade in

#if NOOK_LIGHT
out vec3 nook_directional_ao;

struct NookSum {
  vec4 shadow;
  vec3 added;
};

void nook_add(inout NookSum sum, int key_point, float alpha, float blend) {
  sum.shadow += alpha * nook_texel(nook_shadows, NOOK_COLOUR_VEC4S * key_point);
  sum.added += blend * nook_texel(nook_shadows, NOOK_COLOUR_VEC4S * key_point + 1).xyz;
}
#else
out float nook_ao;

struct NookSum {
  float shadow, added;
};

void nook_add(inout NookSum sum, int key_point, float alpha, float blend) {
  vec2 point = nook_texel(nook_shadows, key_point).xy;
  sum.shadow += alpha * point.x;
  sum.added += blend * point.y;
}
#endif

void nook_add_four(inout NookSum sum, uvec4 key_points, vec4 alpha, vec4 blend, int first) {
  for (int i = 0; i < 4; ++i) nook_add(sum, int(key_points[i]) + first, alpha[i], blend[i]);
}

void main() {
  int first = nook_first_key_point + gl_InstanceID * nook_key_point_count;
  float bias = nook_self != 0 ? nook_bias : 0.0;
#if NOOK_LIGHT
  NookSum sum = NookSum(vec4(0.0), vec3(0.0));
#else
  NookSum sum = NookSum(0.0, 0.0);
#endif
  nook_add_four(sum, nook_key_points_0, nook_alpha_0, nook_blend_0, first);
#if NOOK_QUADS > 1
  nook_add_four(sum, nook_key_points_1, nook_alpha_1, nook_blend_1, first);
#endif
#if NOOK_LIGHT
  vec3 open = nook_combine_light(sum.shadow, sum.added, bias);
  nook_directional_ao = open + nook_hidden * (1.0 - open);
#else
  float ao = nook_form(sum.shadow, sum.added, bias);
  nook_ao = ao + nook_hidden * (1.0 - ao);
#endif
  gl_Position = vec4(0.0);
}
