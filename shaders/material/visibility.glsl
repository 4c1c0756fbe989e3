// Decodes a VOTF.
#if NOOK_VOTF_TERMS > 0
// Returns the mean of the VOTF over several places.
float nook_material_occlusion_at(NookMaterialFetches at, vec3 view) {
  vec2 place = nook_parabolic_place(view, NOOK_VOTF_SIDE);
  ivec2 cell = min(ivec2(place), ivec2(NOOK_VOTF_SIDE - 1));
  NookMaterialTerms terms = nook_votf_terms(place, cell);
  float value = 0.0;
  for (int k = 0; k < NOOK_VOTF_TERMS; ++k) {
    int cluster = nook_votf_cluster(terms, k);
    for (int b = 0; b < NOOK_VOTF_VIEW_VEC4_COUNT; ++b)
      value += dot(nook_votf_weights(terms, k, b), nook_votf_mean(cluster, b, at));
  }
  return value;
}
#endif

// Returns the value of the VOTF, which is a filtered mask or signed distance.
float nook_material_occlusion(vec2 uv, vec2 dx, vec2 dy, vec3 view) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  return nook_material_occlusion_at(nook_material_one_fetch(uv, dx, dy, NOOK_VOTF_TEXELS), view);
#endif
}

// Like nook_material_occlusion, but with several fetches of each mode along the longer side of the pixel.
float nook_material_occlusion_anisotropic(vec2 uv, vec2 dx, vec2 dy, vec3 view, int fetches) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  return nook_material_occlusion_at(nook_material_fetches_along(uv, dx, dy, NOOK_VOTF_TEXELS, fetches), view);
#endif
}

// Applies the visibility mapping, equation (26). The result is 1 if the surface is fully visible, 0 if it is
// invisible, and in between if it is partly visible.
float nook_material_visibility(float occlusion) {
#if NOOK_VOTF_TERMS == 0
  return 1.0;
#else
  if (occlusion >= nook_visibility_mapping.x) return 1.0;
  return occlusion > 0.0 ? min(nook_visibility_mapping.y * occlusion, 1.0) : 0.0;
#endif
}
