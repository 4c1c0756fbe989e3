// The openness that the casters of a frame leave at a point. The table holds four texels for each body: the centre of
// the sphere round it, with its strength over the cut-off and its radius in one number; its first part, the number of
// parts, the squared distance from which one capsule stands for it; that capsule.
// A part has four texels: its centre and the squared distance from which one capsule stands for it; its first caster and
// their number; that capsule. A capsule is two texels, its ends with their radii in AO. Props and occluders are bodies
// of one part that has one caster.
#include "shaders/core/texels.glsl"
#include "shaders/world/coverage.glsl"
#ifdef NOOK_COLOURED
#include "shaders/world/light.glsl"
#endif

#ifndef NOOK_BODIES
#define NOOK_BODIES NOOK_ALL_BODIES
#endif

uniform NOOK_TEXELS nook_world_casters;
uniform int nook_world_groups;

// The casters that the point has evaluated so far.
int nook_world_evaluated = 0;

// The share of a body's casters that counts in this stage.
float nook_world_weight = 1.0;
bool nook_world_far_bodies = NOOK_BODIES == NOOK_FAR_BODIES;

float nook_world_left(float share, vec3 phi, vec3 normal) {
  ++nook_world_evaluated;
#if NOOK_BODIES != NOOK_ALL_BODIES
  share *= nook_world_weight;
#endif
#ifdef NOOK_COLOURED
  nook_world_gather(phi, normal, share);
#endif
  return 1.0 - share;
}

float nook_world_caster_open(int texel, vec3 point, vec3 normal) {
  vec3 phi;
  float share = nook_world_coverage(nook_texel(nook_world_casters, texel), nook_texel(nook_world_casters, texel + 1),
                                    point, normal, phi);
  return nook_world_left(share, phi, normal);
}

float nook_world_merged_open(int texel, vec3 point, vec3 normal) {
  vec3 phi;
  float share = nook_world_far_coverage(nook_texel(nook_world_casters, texel),
                                        nook_texel(nook_world_casters, texel + 1), point, normal, phi);
  return nook_world_left(share, phi, normal);
}

float nook_world_parts_open(int first, int last, vec3 point, vec3 normal) {
  float open = 1.0;
  for (int part = first; part < last; part += NOOK_PART_TEXELS) {
    vec4 place = nook_texel(nook_world_casters, part);
    vec3 d = place.xyz - point;
    if (dot(d, d) > place.w) {
      open *= nook_world_merged_open(part + 2, point, normal);
    } else {
      vec4 range = nook_texel(nook_world_casters, part + 1);
      int from = int(range.x), to = from + NOOK_CASTER_TEXELS * int(range.y);
      for (int k = from; k < to; k += NOOK_CASTER_TEXELS) open *= nook_world_caster_open(k, point, normal);
    }
  }
  return open;
}

float nook_world_body_open(int body, vec3 point, vec3 normal) {
  int texel = NOOK_BODY_TEXELS * body;
  vec4 bound = nook_texel(nook_world_casters, texel);
  vec3 d = bound.xyz - point;
  float radius = bound.w < NOOK_ENDLESS_BOUND ? fract(bound.w) * NOOK_LARGEST_RADIUS : NOOK_ENDLESS_BOUND;
  float distance2 = dot(d, d), gap = sqrt(distance2) - radius;
  // The casters cover at most strength / gap^2, and their cosine is at most that of the top of the sphere, top / gap.
  float top = dot(d, normal) + radius;
  if (top < 0.0 || (gap > 0.0 && bound.w * min(top, gap) < NOOK_STRENGTH_STEPS * gap * gap * gap)) return 1.0;
  vec4 parts = nook_texel(nook_world_casters, texel + 1);
#if NOOK_BODIES != NOOK_ALL_BODIES
  float far = clamp((distance2 / parts.z - NOOK_FAR_FROM) / (1.0 - NOOK_FAR_FROM), 0.0, 1.0);
  nook_world_weight = nook_world_far_bodies ? far : 1.0 - far;
  if (nook_world_weight == 0.0) return 1.0;
  if (nook_world_far_bodies) return nook_world_merged_open(texel + 2, point, normal);
#endif
#if NOOK_BODIES == NOOK_FAR_BODIES
  return 1.0;
#else
  int first = int(parts.x), last = first + NOOK_PART_TEXELS * int(parts.y);
#if NOOK_BODIES == NOOK_ALL_BODIES
  if (distance2 > parts.z) return nook_world_merged_open(texel + 2, point, normal);
#endif
  return nook_world_parts_open(first, last, point, normal);
#endif
}

float nook_world_open(vec3 point, vec3 normal) {
  float open = 1.0;
  for (int body = 0; body < nook_world_groups; ++body) open *= nook_world_body_open(body, point, normal);
  return open;
}
