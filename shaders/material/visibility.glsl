// Decoding of a VOTF.
// Returns the VOTF, a filtered mask or signed distance.
float nook_material_occlusion(vec2 uv, vec2 dx, vec2 dy, vec3 view) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  vec2 place = nook_parabolic_place(view, NOOK_VOTF_SIDE);
  ivec2 cell = min(ivec2(place), ivec2(NOOK_VOTF_SIDE - 1));
  float level = nook_mipmap_level(dx, dy, NOOK_VOTF_TEXELS);
  float value = 0.0;
  uvec4 clusters = uvec4(0u);
#if NOOK_VOTF_BLENDED
  uvec4 last = texelFetch(nook_votf_membership, ivec3(cell, NOOK_VOTF_TERMS / 4), 0);
  nook_material_cell blend = nook_material_blend(place, cell, int(last[NOOK_VOTF_TERMS % 4]));
#endif
  for (int k = 0; k < NOOK_VOTF_TERMS; ++k) {
#if NOOK_VOTF_CLUSTERS > 1
#if NOOK_VOTF_BLENDED
    if (k % 4 == 0)
      clusters = k / 4 == NOOK_VOTF_TERMS / 4 ? last : texelFetch(nook_votf_membership, ivec3(cell, k / 4), 0);
#else
    if (k % 4 == 0) clusters = texelFetch(nook_votf_membership, ivec3(cell, k / 4), 0);
#endif
#endif
    int cluster = int(clusters[k % 4]);
    for (int b = 0; b < NOOK_VOTF_VIEW_VEC4_COUNT; ++b) {
#if NOOK_VOTF_BLENDED
      vec4 coefficients = nook_material_blended(nook_votf_coefficients, blend, k * NOOK_VOTF_VIEW_VEC4_COUNT + b);
#else
      vec4 coefficients = texelFetch(nook_votf_coefficients, ivec3(cell, k * NOOK_VOTF_VIEW_VEC4_COUNT + b), 0);
#endif
      value += dot(coefficients, nook_votf_mode(cluster, b, uv, level));
    }
  }
  return value;
#endif
}

// The visibility mapping, equation (26): 1 is fully visible, 0 is invisible, and values between are partly
// visible.
float nook_material_visibility(float occlusion) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  if (occlusion >= nook_visibility_mapping.x) return 1.0;
  return occlusion > 0.0 ? min(nook_visibility_mapping.y * occlusion, 1.0) : 0.0;
#endif
}
