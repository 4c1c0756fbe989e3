#include "shaders/character/specular_numbers.h"

// Returns the bent normal of a vertex. Pass its unit normal and its two occluded directions
// (sdk/src/character/bent_normal.h), all in the same space. Also pass its AO, where 1 means fully open.
vec3 nook_scene_bent_normal(vec3 normal, vec3 occluded_dark, vec3 occluded_open, float ao) {
  vec3 left = normal * (2.0 / 3.0) - mix(occluded_dark, occluded_open, ao);
  return dot(left, left) > 1.0e-12 ? normalize(left) : normal;
}

// Returns the share of a glossy reflection that reaches the viewer. All directions must be unit vectors in
// the same space. An `ao` of 1 means fully open. `roughness` is the perceptual roughness: the GGX width is
// its square. Evaluates the network of sdk/src/nnao/lighting.h. Its weights were fitted to characters, where
// bodies hide light at any distance. If AO is 1, the result is exactly 1.
float nook_scene_specular_occlusion(vec3 bent_normal, float ao, vec3 normal, vec3 to_viewer, float roughness) {
  float facing = clamp(dot(normal, to_viewer), 0.0, 1.0), cone = sqrt(clamp(1.0 - ao, 0.0, 1.0));
  float towards = dot(bent_normal, 2.0 * facing * normal - to_viewer), bend = dot(normal, bent_normal);
  vec4 low = cone * vec4(NOOK_SCENE_SPECULAR_0) + towards * vec4(NOOK_SCENE_SPECULAR_2) +
             facing * vec4(NOOK_SCENE_SPECULAR_4) + bend * vec4(NOOK_SCENE_SPECULAR_6) +
             roughness * vec4(NOOK_SCENE_SPECULAR_8) + vec4(NOOK_SCENE_SPECULAR_10);
  vec4 high = cone * vec4(NOOK_SCENE_SPECULAR_1) + towards * vec4(NOOK_SCENE_SPECULAR_3) +
              facing * vec4(NOOK_SCENE_SPECULAR_5) + bend * vec4(NOOK_SCENE_SPECULAR_7) +
              roughness * vec4(NOOK_SCENE_SPECULAR_9) + vec4(NOOK_SCENE_SPECULAR_11);
  float hidden = dot(max(low, 0.0), vec4(NOOK_SCENE_SPECULAR_12)) +
                 dot(max(high, 0.0), vec4(NOOK_SCENE_SPECULAR_13)) + NOOK_SCENE_SPECULAR_BIAS;
  float squared = roughness * roughness;
  return clamp(mix(1.0 - cone * hidden, ao, squared * squared), 0.0, 1.0);
}
