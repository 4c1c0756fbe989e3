// Decodes a clustered BTF, with or without a relief.
#if NOOK_RELIEF
// Returns the point of the tile over which the view's ray through uv first meets the relief.
// sdk/src/material/relief_tables.cpp has the same function.
vec2 nook_material_relief(vec2 uv, vec3 view, float level) {
  float across = length(view.xy);
  vec2 slope = view.xy * (view.z * nook_relief_max_slope > across ? 1.0 / max(view.z, 1e-6)
                                                                  : nook_relief_max_slope / max(across, 1e-6));
  vec2 lowest = uv + nook_relief_low * slope, rise = (nook_relief_high - nook_relief_low) * slope;
#if NOOK_RELIEF_STEPS == 0
  return lowest + rise;
#else
  float above_share = 1.0;
  float above = 1.0 - textureLod(nook_relief_heights, vec3(lowest + rise, 0.0), level).x;
  for (int i = 1; i <= NOOK_RELIEF_STEPS && above > 0.0; ++i) {
    float share = 1.0 - float(i) / float(NOOK_RELIEF_STEPS);
    float over = share - textureLod(nook_relief_heights, vec3(lowest + share * rise, 0.0), level).x;
    if (over <= 0.0) return lowest + (above_share + (share - above_share) * above / (above - over)) * rise;
    above_share = share;
    above = over;
  }
  return lowest + above_share * rise;
#endif
}
#endif

// Computes the mean light modes of several places for the view. If there is a relief, each place is first
// replaced by the point where the view's ray through the place hits the relief.
void nook_material_decode_at(NookMaterialFetches at, vec3 view, out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  vec2 place = nook_parabolic_place(view, NOOK_BTF_SIDE);
  ivec2 cell = min(ivec2(place), ivec2(NOOK_BTF_SIDE - 1));
#if NOOK_RELIEF
  for (int i = 0; i < at.count; ++i) at.place[i] = nook_material_relief(at.place[i], view, at.level);
#endif
  for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a) modes[a] = vec4(0.0);
  NookMaterialTerms terms = nook_btf_terms(place, cell);
  for (int k = 0; k < NOOK_BTF_TERMS; ++k) {
    int cluster = nook_btf_cluster(terms, k);
    for (int b = 0; b < NOOK_BTF_VIEW_VEC4_COUNT; ++b) {
      vec4 coefficients = nook_btf_weights(terms, k, b);
      for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a) {
        int mode = a * 4 * NOOK_BTF_VIEW_VEC4_COUNT + b;
        modes[a] += vec4(dot(coefficients, nook_btf_mean(cluster, mode, at)),
                         dot(coefficients, nook_btf_mean(cluster, mode + NOOK_BTF_VIEW_VEC4_COUNT, at)),
                         dot(coefficients, nook_btf_mean(cluster, mode + 2 * NOOK_BTF_VIEW_VEC4_COUNT, at)),
                         dot(coefficients, nook_btf_mean(cluster, mode + 3 * NOOK_BTF_VIEW_VEC4_COUNT, at)));
      }
    }
  }
}

// Computes the light modes at the point uv for the view. dx and dy are the derivatives of uv along the
// pixel's sides. The function filters over the pixel.
void nook_material_decode(vec2 uv, vec2 dx, vec2 dy, vec3 view, out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  nook_material_decode_at(nook_material_one_fetch(uv, dx, dy, NOOK_BTF_TEXELS), view, modes);
}

// Like nook_material_decode, but with several fetches of each mode along the longer side of the pixel, which
// keeps grazing views sharp.
void nook_material_decode_anisotropic(vec2 uv, vec2 dx, vec2 dy, vec3 view, int fetches,
                                      out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  nook_material_decode_at(nook_material_fetches_along(uv, dx, dy, NOOK_BTF_TEXELS, fetches), view, modes);
}

// Returns the radiance towards the view for a light that causes an irradiance of 1 on a plane facing the
// light. Because of compression, a sum may be slightly negative; it is clamped to 0.
vec3 nook_material_radiance(vec4 modes[NOOK_LIGHT_VEC4_COUNT], vec3 light) {
  vec3 radiance = vec3(0.0);
  if (light.z <= 0.0) return radiance;
  vec2 at = 0.5 * nook_parabolic(light) + 0.5;
  for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a)
    radiance += vec3(dot(modes[a], textureLod(nook_light_map, vec3(at, float(a)), 0.0)),
                     dot(modes[a], textureLod(nook_light_map, vec3(at, float(a + NOOK_LIGHT_VEC4_COUNT)), 0.0)),
                     dot(modes[a], textureLod(nook_light_map, vec3(at, float(a + 2 * NOOK_LIGHT_VEC4_COUNT)), 0.0)));
  return max(radiance, 0.0);
}
