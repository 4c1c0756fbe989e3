// Call these functions in a host's shader that lights with AO and bent normals. Pass all directions as unit
// vectors in the same space, which you can choose. An AO of 1 means fully open.
#include "shaders/nnao/specular_numbers.h"

// Returns the bent normal in view space from a texel of the pass's texture, whose alpha is AO.
vec3 nook_nnao_bent_normal(vec4 texel) {
  return normalize(2.0 * texel.rgb - 1.0);
}

// The visibility cone is the cone around the bent normal that has the same AO as the point. Returns the
// cosine of its half angle. A cone around the normal covers the cosine-weighted fraction 1 - cos^2 of the
// hemisphere.
float nook_nnao_cone_cosine(float ao) {
  return sqrt(clamp(1.0 - ao, 0.0, 1.0));
}

// Returns AO brightened by light that the surroundings reflect. It is the share of uniform light that reaches
// a diffuse point if its surroundings have the same albedo and reflect light, too (J. Jimenez, X. Wu, A.
// Pesce, A. Jarabo, Practical realtime strategies for accurate indirect occlusion, 2016). Plain AO assumes
// black surroundings, which looks too dark.
vec3 nook_nnao_multi_bounce(float ao, vec3 albedo) {
  vec3 a = 2.0404 * albedo - 0.3324, b = 0.6417 - 4.7951 * albedo, c = 2.7552 * albedo + 0.6903;
  return max(vec3(ao), ((ao * a + b) * ao + c) * ao);
}

// Returns the factor by which to multiply a glossy reflection (specular occlusion). `roughness` is
// perceptual: the GGX width is its square. The function is a network with eight hidden units.
// sdk/src/nnao/lighting.h defines it, and `nook train specular` has fitted it to ray tracing. If AO is 1, the
// result is exactly 1.
float nook_nnao_specular_occlusion(vec3 bent_normal, float ao, vec3 normal, vec3 to_viewer, float roughness) {
  float facing = clamp(dot(normal, to_viewer), 0.0, 1.0), cone = nook_nnao_cone_cosine(ao);
  float towards = dot(bent_normal, 2.0 * facing * normal - to_viewer), bend = dot(normal, bent_normal);
  vec4 low = cone * vec4(NOOK_SPECULAR_0) + towards * vec4(NOOK_SPECULAR_2) + facing * vec4(NOOK_SPECULAR_4) +
             bend * vec4(NOOK_SPECULAR_6) + roughness * vec4(NOOK_SPECULAR_8) + vec4(NOOK_SPECULAR_10);
  vec4 high = cone * vec4(NOOK_SPECULAR_1) + towards * vec4(NOOK_SPECULAR_3) + facing * vec4(NOOK_SPECULAR_5) +
              bend * vec4(NOOK_SPECULAR_7) + roughness * vec4(NOOK_SPECULAR_9) + vec4(NOOK_SPECULAR_11);
  float hidden = dot(max(low, 0.0), vec4(NOOK_SPECULAR_12)) + dot(max(high, 0.0), vec4(NOOK_SPECULAR_13)) +
                 NOOK_SPECULAR_BIAS;
  float squared = roughness * roughness;
  return clamp(mix(1.0 - cone * hidden, ao, squared * squared), 0.0, 1.0);
}
