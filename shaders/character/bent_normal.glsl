// The bent normal of a vertex, from its unit normal and its two blocked vectors (sdk/src/character/bent_normal.h),
// all in one space. ao is 1 where open.
vec3 nook_scene_bent_normal(vec3 normal, vec3 blocked_dark, vec3 blocked_open, float ao) {
  vec3 left = normal * (2.0 / 3.0) - mix(blocked_dark, blocked_open, ao);
  return dot(left, left) > 1.0e-12 ? normalize(left) : normal;
}
