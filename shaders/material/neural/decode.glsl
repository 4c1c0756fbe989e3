// Evaluates the network of a neural material. neural.h in sdk/src/material has the equations, and
// neural_tables.cpp has the same functions. Matrices are stored in blocks of 4 x 4. The blocks of the same
// four inputs are adjacent. Two layers read features. Their last inputs are the view and 1. The result for a
// pixel is `modes`. It contains the sums of the first layer without the light, followed by the view.

vec4 nook_neural_rectified(vec4 sum) { return max(sum, nook_neural_leak * sum); }

// Raises a direction that is lower than the lowest sampled direction to the height of that direction.
vec3 nook_neural_raised(vec3 d, float lowest) {
  return d.z >= lowest ? d : vec3(d.xy * (sqrt(1.0 - lowest * lowest) / max(length(d.xy), 1e-6)), lowest);
}

vec4 nook_neural_feature(int layer, vec2 uv, float level) {
  return textureLod(nook_neural_features, vec3(uv, float(layer)), level);
}

// Returns the height, in tiles, at which a view reads the features.
float nook_neural_height(vec2 uv, float level, vec3 view) {
  vec4 units[NOOK_NEURAL_OFFSET_UNIT_VEC4S];
  for (int u = 0; u < NOOK_NEURAL_OFFSET_UNIT_VEC4S; ++u)
    units[u] = nook_neural_offset_in[NOOK_NEURAL_OFFSET_VEC4S * NOOK_NEURAL_OFFSET_UNIT_VEC4S + u] * vec4(view, 1.0);
  for (int i = 0; i < NOOK_NEURAL_OFFSET_VEC4S; ++i) {
    vec4 feature = nook_neural_feature(NOOK_NEURAL_FEATURE_VEC4S + i, uv, level);
    for (int u = 0; u < NOOK_NEURAL_OFFSET_UNIT_VEC4S; ++u)
      units[u] += nook_neural_offset_in[i * NOOK_NEURAL_OFFSET_UNIT_VEC4S + u] * feature;
  }
  float height = nook_neural_offset_level;
  for (int u = 0; u < NOOK_NEURAL_OFFSET_UNIT_VEC4S; ++u)
    height += dot(nook_neural_offset_out[u], nook_neural_rectified(units[u]));
  return height;
}

vec4 nook_neural_mean(int layer, NookMaterialFetches at) {
  vec4 mean = nook_neural_feature(layer, at.place[0], at.level);
  for (int i = 1; i < at.count; ++i)
    mean += (nook_neural_feature(layer, at.place[i], at.level) - mean) / float(i + 1);
  return mean;
}

// Computes `modes` for the view from the mean features of several places. The height is computed separately
// for each place.
void nook_material_decode_at(NookMaterialFetches at, vec3 view, out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  view = nook_neural_raised(view, nook_neural_lowest_view_z);
  for (int i = 0; i < at.count; ++i) {
    float height = nook_neural_height(at.place[i], at.level, view);
    if (abs(height) < 1.0) at.place[i] += view.xy * (height / max(view.z, nook_neural_least_view_z));
  }
  for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u)
    modes[u] = nook_neural_position[NOOK_NEURAL_FEATURE_VEC4S * NOOK_NEURAL_UNIT_VEC4S + u] * vec4(view, 1.0);
  for (int i = 0; i < NOOK_NEURAL_FEATURE_VEC4S; ++i) {
    vec4 feature = nook_neural_mean(i, at);
    for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u)
      modes[u] += nook_neural_position[i * NOOK_NEURAL_UNIT_VEC4S + u] * feature;
  }
  modes[NOOK_NEURAL_UNIT_VEC4S] = vec4(view, 0.0);
}

// Computes `modes` at the point uv for the view. dx and dy are the derivatives of uv along the pixel's sides.
// The function filters the features over the pixel.
void nook_material_decode(vec2 uv, vec2 dx, vec2 dy, vec3 view, out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  nook_material_decode_at(nook_material_one_fetch(uv, dx, dy, NOOK_BTF_TEXELS), view, modes);
}

// Like nook_material_decode, but with several fetches of each feature along the longer side of the pixel,
// which keeps grazing views sharp.
void nook_material_decode_anisotropic(vec2 uv, vec2 dx, vec2 dy, vec3 view, int fetches,
                                      out vec4 modes[NOOK_LIGHT_VEC4_COUNT]) {
  nook_material_decode_at(nook_material_fetches_along(uv, dx, dy, NOOK_BTF_TEXELS, fetches), view, modes);
}

// Returns the radiance towards the view for a light that causes an irradiance of 1 on a plane facing the
// light.
vec3 nook_material_radiance(vec4 modes[NOOK_LIGHT_VEC4_COUNT], vec3 light) {
  if (light.z <= 0.0) return vec3(0.0);
  float share = light.z < nook_neural_lowest_light_z ? light.z / nook_neural_lowest_light_z : 1.0;
  light = nook_neural_raised(light, nook_neural_lowest_light_z);
  vec3 halfway = modes[NOOK_NEURAL_UNIT_VEC4S].xyz + light;
  halfway /= max(length(halfway), 1e-6);
  vec4 units[NOOK_NEURAL_UNIT_VEC4S];
  for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u)
    units[u] = nook_neural_rectified(modes[u] + nook_neural_light[u] * light +
                                     nook_neural_light[NOOK_NEURAL_UNIT_VEC4S + u] * halfway);
#if NOOK_NEURAL_LAYERS > 1
  for (int l = 0; l < NOOK_NEURAL_LAYERS - 1; ++l) {
    vec4 next[NOOK_NEURAL_UNIT_VEC4S];
    for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u) next[u] = nook_neural_hidden_bias[l * NOOK_NEURAL_UNIT_VEC4S + u];
    for (int i = 0; i < NOOK_NEURAL_UNIT_VEC4S; ++i)
      for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u)
        next[u] += nook_neural_hidden[(l * NOOK_NEURAL_UNIT_VEC4S + i) * NOOK_NEURAL_UNIT_VEC4S + u] * units[i];
    for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u) units[u] = nook_neural_rectified(next[u]);
  }
#endif
  vec3 radiance = nook_neural_out_bias;
  for (int u = 0; u < NOOK_NEURAL_UNIT_VEC4S; ++u) radiance += nook_neural_out[u] * units[u];
  return max(radiance, 0.0) * share;
}
