// Finds the places in the material's tile at which a pixel reads it. sdk/src/material/footprint.h describes
// them and has the same functions.

// The pixel's value is the mean over the first `count` places. All places have the same mipmap level.
struct NookMaterialFetches {
  int count;
  float level;
  vec2 place[NOOK_MATERIAL_MAX_FETCHES];
};

// Returns a single place. Its mipmap level is chosen as if both sides of the pixel were as long as the longer
// one.
NookMaterialFetches nook_material_one_fetch(vec2 uv, vec2 dx, vec2 dy, vec2 texels) {
  NookMaterialFetches at;
  at.count = 1;
  at.level = nook_mipmap_level(dx, dy, texels);
  at.place[0] = uv;
  return at;
}

// Returns `fetches` places, 1 to NOOK_MATERIAL_MAX_FETCHES, along the longer axis of the pixel's footprint.
NookMaterialFetches nook_material_fetches_along(vec2 uv, vec2 dx, vec2 dy, vec2 texels, int fetches) {
  vec2 across = vec2(dx.x, dy.x) * texels.x, up = vec2(dx.y, dy.y) * texels.y;
  float xx = dot(across, across), yy = dot(up, up), xy = dot(across, up);
  float mean = 0.5 * (xx + yy), half_difference = 0.5 * (xx - yy);
  float from_mean = sqrt(half_difference * half_difference + xy * xy), longer2 = mean + from_mean;
  // This is also false if a derivative is NaN.
  bool is_in_range = longer2 < 1e18;
  NookMaterialFetches at;
  at.count = clamp(fetches, 1, NOOK_MATERIAL_MAX_FETCHES);
  float side2 = max(mean - from_mean, longer2 / float(at.count * at.count));
  at.level = is_in_range ? 0.5 * log2(max(side2, 1e-30)) : 30.0;
  vec2 along = half_difference >= 0.0 ? vec2(from_mean + half_difference, xy)
                                      : vec2(xy, from_mean - half_difference);
  float direction = length(along);
  vec2 reach = is_in_range && direction > 1e-12
                   ? along * (0.5 * (sqrt(longer2) - sqrt(side2)) / direction) / texels
                   : vec2(0.0);
  for (int i = 0; i < at.count; ++i)
    at.place[i] = uv + (at.count > 1 ? 2.0 * float(i) / float(at.count - 1) - 1.0 : 0.0) * reach;
  return at;
}
