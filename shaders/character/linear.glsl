// The last step of the linear layer, for both tiers.
#include "shaders/character/constants.h"

// Computes the formula of slide 23 of Le et al. 2019, multiplied by the second factor of the composed form.
// `shadow` is the sum of alpha * shadow, and `added` is the sum of blend weight * added occlusion. Pass the
// bias 0 if self-shadow is off.
float nook_form(float shadow, float added, float bias) {
  float self = clamp(1.0 - (shadow + bias), 0.0, 1.0);
  return self * clamp(1.0 - added, 0.0, 1.0);
}

// Computes the same formula for each colour channel of an instance with a light. shadow.xyz is the sum of
// alpha * coloured shadow, and shadow.w the sum of alpha * shadow. The ratio is explained in
// sdk/src/character/directional_occlusion.h.
vec3 nook_combine_light(vec4 shadow, vec3 added, float bias) {
  vec3 ratio = (shadow.xyz + NOOK_SMALLEST_SHARE) / (max(shadow.w, 0.0) + NOOK_SMALLEST_SHARE);
  vec3 self = clamp(1.0 - max(shadow.w + bias, 0.0) * ratio, 0.0, 1.0);
  return self * clamp(1.0 - added, 0.0, 1.0);
}
