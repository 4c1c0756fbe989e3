// The last step of the linear layer for both tiers: slide 23 of Le et al. 2019, and the second factor of the
// composed form. shadow is the sum of alpha * shadow, added the sum of blend weight * added occlusion. bias
// is 0 where self-shadow is switched off.
float nook_combine(float shadow, float added, float bias) {
  float self = clamp(1.0 - (shadow + bias), 0.0, 1.0);
  return self * clamp(1.0 - added, 0.0, 1.0);
}
