// Decoding of a VOTF.
#if NOOK_VOTF_TERMS > 0
vec4 nook_votf_mean(int cluster, int mode, NookMaterialFetches at) {
  vec4 mean = nook_votf_mode(cluster, mode, at.place[0], at.level);
  for (int i = 1; i < at.count; ++i)
    mean += (nook_votf_mode(cluster, mode, at.place[i], at.level) - mean) / float(i + 1);
  return mean;
}

// Returns the mean of the VOTF over places.
float nook_material_occlusion_at(NookMaterialFetches at, vec3 view) {
  vec2 place = nook_parabolic_place(view, NOOK_VOTF_SIDE);
  ivec2 cell = min(ivec2(place), ivec2(NOOK_VOTF_SIDE - 1));
  float value = 0.0;
  uvec4 clusters = uvec4(0u);
#if NOOK_VOTF_BLENDED
  uvec4 last = texelFetch(nook_votf_membership, ivec3(cell, NOOK_VOTF_TERMS / 4), 0);
  NookMaterialCell blend = nook_material_blend(place, cell, int(last[NOOK_VOTF_TERMS % 4]));
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
      value += dot(coefficients, nook_votf_mean(cluster, b, at));
    }
  }
  return value;
}
#endif

// Returns the VOTF, a filtered mask or signed distance.
float nook_material_occlusion(vec2 uv, vec2 dx, vec2 dy, vec3 view) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  return nook_material_occlusion_at(nook_material_one_fetch(uv, dx, dy, NOOK_VOTF_TEXELS), view);
#endif
}

// The same with several fetches of each mode along the longer side of the pixel.
float nook_material_occlusion_anisotropic(vec2 uv, vec2 dx, vec2 dy, vec3 view, int fetches) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  return nook_material_occlusion_at(nook_material_fetches_along(uv, dx, dy, NOOK_VOTF_TEXELS, fetches), view);
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
