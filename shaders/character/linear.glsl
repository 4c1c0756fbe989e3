// The last step of the linear layer, for both tiers: slide 23, and the composed form's second factor.
// shadow: sum of alpha * shadow; added: sum of blend weight * added occlusion; bias 0 where self-shadow is switched off.
float nook_combine(float shadow, float added, float bias) {
  float self = clamp(1.0 - (shadow + bias), 0.0, 1.0);
  return self * clamp(1.0 - added, 0.0, 1.0);
}
