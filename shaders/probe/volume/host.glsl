// Reads a grid of probes from a 3D texture of half floats, in the layout of sdk/src/gl/probe/grid_volume.cpp.
// Layers, each as large as the grid, are stacked along z. The first NOOK_GRID_TEXELS layers contain the
// coefficients of each probe, four values per texel. If there are walls, the next three layers contain the
// planes of each cell, and the last two layers contain the masks of the cell's sides.
#include "shaders/probe/harmonics.glsl"

#if NOOK_GRID_TEXELS == NOOK_GRID_HARMONICS_TEXELS
#define NookGridLight NookHarmonics
#else
#define NookGridLight NookZonalHarmonics
#endif

uniform highp sampler3D nook_grid_texels;
// Four rows: the first probe's position and the bias of walls, in metres; 1 / spacing; the number of probes
// along each axis; and 1 / the texture's size in texels.
uniform highp vec4 nook_grid_frame[4];

// Coefficients of a probe in the order of its texels.
struct NookGridTexels {
  vec4 texel[NOOK_GRID_TEXELS];
};

NookGridLight nook_grid_unpacked(NookGridTexels t) {
  NookGridLight light;
  light.coefficient[0] = t.texel[0].xyz;
  light.coefficient[1] = vec3(t.texel[0].w, t.texel[1].xy);
  light.coefficient[2] = vec3(t.texel[1].zw, t.texel[2].x);
  light.coefficient[3] = t.texel[2].yzw;
#if NOOK_GRID_TEXELS == NOOK_GRID_HARMONICS_TEXELS
  light.coefficient[4] = t.texel[3].xyz;
  light.coefficient[5] = vec3(t.texel[3].w, t.texel[4].xy);
  light.coefficient[6] = vec3(t.texel[4].zw, t.texel[5].x);
  light.coefficient[7] = t.texel[5].yzw;
  light.coefficient[8] = t.texel[6].xyz;
#else
  light.zonal = t.texel[3].xyz;
#endif
  return light;
}

// Interpolates trilinearly with the texture unit. `at` is the position relative to the first probe, in units
// of the spacing.
NookGridTexels nook_grid_filtered(vec3 at) {
  vec3 uvw = (clamp(at, vec3(0.0), nook_grid_frame[2].xyz - 1.0) + 0.5) * nook_grid_frame[3].xyz;
  float layer = nook_grid_frame[2].z * nook_grid_frame[3].z;
  NookGridTexels t;
  for (int i = 0; i < NOOK_GRID_TEXELS; ++i)
    t.texel[i] = textureLod(nook_grid_texels, vec3(uvw.xy, uvw.z + layer * float(i)), 0.0);
  return t;
}

#ifdef NOOK_GRID_WALLS
// Interpolates only the probes of a cell that the mask selects. `in_cell` is the position relative to the
// cell's first probe, in units of the spacing.
NookGridTexels nook_grid_masked(ivec3 cell, vec3 in_cell, int mask) {
  ivec3 last = ivec3(nook_grid_frame[2].xyz) - 1;
  vec3 high = clamp(in_cell, vec3(NOOK_GRID_LEAST_SHARE), vec3(1.0 - NOOK_GRID_LEAST_SHARE)), low = 1.0 - high;
  NookGridTexels t;
  for (int i = 0; i < NOOK_GRID_TEXELS; ++i) t.texel[i] = vec4(0.0);
  float sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    ivec3 step = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
    vec3 share = mix(low, high, vec3(step));
    float weight = share.x * share.y * share.z * float(mask >> corner & 1);
    if (weight > 0.0) {
      sum += weight;
      ivec3 probe = min(cell + step, last);
      for (int i = 0; i < NOOK_GRID_TEXELS; ++i)
        t.texel[i] += weight * texelFetch(nook_grid_texels, probe + ivec3(0, 0, i * (last.z + 1)), 0);
    }
  }
  for (int i = 0; i < NOOK_GRID_TEXELS; ++i) t.texel[i] /= sum;
  return t;
}
#endif

// Returns the light at a point of a surface. Pass the result to nook_sh_irradiance, or with ZH3 to
// nook_zh3_irradiance. The normal is used only if there are walls.
NookGridLight nook_grid_light(vec3 position_ws, vec3 normal) {
#ifdef NOOK_GRID_WALLS
  position_ws += normal * nook_grid_frame[0].w;
#endif
  vec3 at = (position_ws - nook_grid_frame[0].xyz) * nook_grid_frame[1].xyz;
#ifdef NOOK_GRID_WALLS
  ivec3 counts = ivec3(nook_grid_frame[2].xyz);
  ivec3 cell = ivec3(clamp(at, vec3(0.0), vec3(max(counts - 2, 0))));
  vec3 in_cell = at - vec3(cell);
  ivec3 texel = cell + ivec3(0, 0, NOOK_GRID_TEXELS * counts.z);
  int side = 0;
  for (int k = 0; k < NOOK_GRID_PLANES; ++k) {
    vec4 plane = texelFetch(nook_grid_texels, texel + ivec3(0, 0, k * counts.z), 0);
    if (dot(plane.xyz, in_cell) + plane.w < 0.0) side |= 1 << k;
  }
  vec4 masks = texelFetch(nook_grid_texels, texel + ivec3(0, 0, (NOOK_GRID_PLANES + (side >> 2)) * counts.z), 0);
  int mask = int(masks[side & 3]);
  if (mask != 255) return nook_grid_unpacked(nook_grid_masked(cell, in_cell, mask));
#endif
  return nook_grid_unpacked(nook_grid_filtered(at));
}

// Returns the irradiance on a surface, at least 0.
vec3 nook_grid_irradiance(vec3 position_ws, vec3 normal) {
#if NOOK_GRID_TEXELS == NOOK_GRID_HARMONICS_TEXELS
  return nook_sh_irradiance(nook_grid_light(position_ws, normal), normal);
#else
  return nook_zh3_irradiance(nook_grid_light(position_ws, normal), normal);
#endif
}
