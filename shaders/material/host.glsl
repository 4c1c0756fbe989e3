// The functions of a host's shader. sdk/src/gl/material/source.cpp writes the constants, the samplers and the
// functions
//   vec4 nook_btf_mode(int layer, vec2 uv, float level)
//   vec4 nook_votf_mode(int layer, vec2 uv, float level)
// before this text, for the sizes of a material. sdk/src/material/tables.h defines the layout of layers and
// numbers, and sdk/src/material/evaluate.cpp has the same functions.
#include "shaders/material/parabolic.glsl"

// Returns the mipmap level of a pixel with the sides dx and dy. All fetches share it, so that they need no
// derivatives, which is faster and works in branches.
float nook_mipmap_level(vec2 dx, vec2 dy, vec2 texels) {
  dx *= texels;
  dy *= texels;
  return 0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1e-30));
}

// A cell of a view map, with the neighbours along x and y that it blends with and their weights.
struct nook_material_cell {
  ivec2 cell, x, y;
  float weight_x, weight_y;
};

// Finds the cell of a view and its neighbours, whose steps are two bits for each half of the cell, plus 1.
// sdk/src/material/view_cells.h has the same function.
nook_material_cell nook_material_blend(vec2 place, ivec2 cell, int neighbours) {
  vec2 at = place - vec2(cell) - 0.5;
  int x = (neighbours >> (at.x > 0.0 ? 2 : 0) & 3) - 1, y = (neighbours >> (at.y > 0.0 ? 6 : 4) & 3) - 1;
  return nook_material_cell(cell, cell + ivec2(x, 0), cell + ivec2(0, y), at.x * float(x), at.y * float(y));
}

vec4 nook_material_blended(highp sampler2DArray coefficients, nook_material_cell c, int layer) {
  return texelFetch(coefficients, ivec3(c.cell, layer), 0) * (1.0 - c.weight_x - c.weight_y) +
         texelFetch(coefficients, ivec3(c.x, layer), 0) * c.weight_x +
         texelFetch(coefficients, ivec3(c.y, layer), 0) * c.weight_y;
}

#if NOOK_RELIEF
// Returns the point of the tile over which the view's ray through uv first meets the relief.
// sdk/src/material/relief.cpp has the same function.
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

// Computes the light modes of the point uv for the view, filtered over the pixel with the sides dx and dy.
void nook_material_decode(vec2 uv, vec2 dx, vec2 dy, vec3 view, out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  vec2 place = nook_parabolic_place(view, NOOK_BTF_SIDE);
  ivec2 cell = min(ivec2(place), ivec2(NOOK_BTF_SIDE - 1));
  float level = nook_mipmap_level(dx, dy, NOOK_BTF_TEXELS);
#if NOOK_RELIEF
  uv = nook_material_relief(uv, view, level);
#endif
  for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a) modes[a] = vec4(0.0);
  uvec4 clusters = uvec4(0u);
#if NOOK_BTF_BLENDED
  uvec4 last = texelFetch(nook_btf_membership, ivec3(cell, NOOK_BTF_TERMS / 4), 0);
  nook_material_cell blend = nook_material_blend(place, cell, int(last[NOOK_BTF_TERMS % 4]));
#endif
  for (int k = 0; k < NOOK_BTF_TERMS; ++k) {
#if NOOK_BTF_CLUSTERS > 1
#if NOOK_BTF_BLENDED
    if (k % 4 == 0)
      clusters = k / 4 == NOOK_BTF_TERMS / 4 ? last : texelFetch(nook_btf_membership, ivec3(cell, k / 4), 0);
#else
    if (k % 4 == 0) clusters = texelFetch(nook_btf_membership, ivec3(cell, k / 4), 0);
#endif
#endif
    int first = int(clusters[k % 4]) * NOOK_LIGHT_VEC4_COUNT * 4 * NOOK_BTF_VIEW_VEC4_COUNT;
    for (int b = 0; b < NOOK_BTF_VIEW_VEC4_COUNT; ++b) {
#if NOOK_BTF_BLENDED
      vec4 coefficients = nook_material_blended(nook_btf_coefficients, blend, k * NOOK_BTF_VIEW_VEC4_COUNT + b);
#else
      vec4 coefficients = texelFetch(nook_btf_coefficients, ivec3(cell, k * NOOK_BTF_VIEW_VEC4_COUNT + b), 0);
#endif
      for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a) {
        int layer = first + a * 4 * NOOK_BTF_VIEW_VEC4_COUNT + b;
        modes[a] += vec4(dot(coefficients, nook_btf_mode(layer, uv, level)),
                         dot(coefficients, nook_btf_mode(layer + NOOK_BTF_VIEW_VEC4_COUNT, uv, level)),
                         dot(coefficients, nook_btf_mode(layer + 2 * NOOK_BTF_VIEW_VEC4_COUNT, uv, level)),
                         dot(coefficients, nook_btf_mode(layer + 3 * NOOK_BTF_VIEW_VEC4_COUNT, uv, level)));
      }
    }
  }
}

// Returns the radiance towards the view for an irradiance of 1 on a plane that faces the light.
vec3 nook_material_radiance(vec4 modes[NOOK_LIGHT_VEC4_COUNT], vec3 light) {
  vec3 radiance = vec3(0.0);
  if (light.z <= 0.0) return radiance;
  vec2 at = 0.5 * nook_parabolic(light) + 0.5;
  for (int a = 0; a < NOOK_LIGHT_VEC4_COUNT; ++a)
    radiance += vec3(dot(modes[a], textureLod(nook_light_map, vec3(at, float(a)), 0.0)),
                     dot(modes[a], textureLod(nook_light_map, vec3(at, float(a + NOOK_LIGHT_VEC4_COUNT)), 0.0)),
                     dot(modes[a], textureLod(nook_light_map, vec3(at, float(a + 2 * NOOK_LIGHT_VEC4_COUNT)), 0.0)));
  return radiance;
}

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
    int first = int(clusters[k % 4]) * NOOK_VOTF_VIEW_VEC4_COUNT;
    for (int b = 0; b < NOOK_VOTF_VIEW_VEC4_COUNT; ++b) {
#if NOOK_VOTF_BLENDED
      vec4 coefficients = nook_material_blended(nook_votf_coefficients, blend, k * NOOK_VOTF_VIEW_VEC4_COUNT + b);
#else
      vec4 coefficients = texelFetch(nook_votf_coefficients, ivec3(cell, k * NOOK_VOTF_VIEW_VEC4_COUNT + b), 0);
#endif
      value += dot(coefficients, nook_votf_mode(first + b, uv, level));
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
