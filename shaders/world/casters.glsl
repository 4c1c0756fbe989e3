// Computes the openness at a point, which is the share of its hemisphere that the casters of a frame do not
// cover. The table has four texels for each body. The first contains the centre of the sphere around the
// body, and one float that encodes both the sphere's radius and strength / cut-off. The second contains the
// index of the texel of the first part, the number of parts, and a squared distance. The other two contain a
// capsule, which replaces the body at larger distances. A part has four texels, too. The first contains its
// centre and a squared distance. The second contains the index of the texel of its first caster, and the
// number of casters. The other two contain a capsule, which replaces the part at larger distances. Each
// capsule is stored as its two ends, with their radii for AO. Props and occluders are bodies with one part
// and one caster.
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

// Counters for this point: evaluated capsules of all kinds, evaluated capsules that are casters, and bodies
// whose reach was tested.
int nook_world_evaluated = 0;
int nook_world_exact = 0;
int nook_world_tested = 0;

// Returns a texel of a part of a body. A stage may define it differently, to read the texel from its shared
// memory.
#ifndef nook_world_part_texel
#define nook_world_part_texel(number) nook_texel(nook_world_casters, number)
#endif

// The weight of the current body's casters in this stage; see nook_world_far_share.
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
  ++nook_world_exact;
  return nook_world_left(share, phi, normal);
}

// Returns the openness that remains after occlusion by a capsule, which replaces a part or a body. Pass the
// ends of the capsule.
float nook_world_merged_open(vec4 end_a, vec4 end_b, vec3 point, vec3 normal) {
  vec3 phi;
  float share = nook_world_far_coverage(end_a, end_b, point, normal, phi);
  return nook_world_left(share, phi, normal);
}

float nook_world_parts_open(int first, int last, vec3 point, vec3 normal) {
  float open = 1.0;
  for (int part = first; part < last; part += NOOK_PART_TEXELS) {
    vec4 place = nook_world_part_texel(part);
    vec3 d = place.xyz - point;
    if (dot(d, d) > place.w) {
      open *= nook_world_merged_open(nook_world_part_texel(part + 2), nook_world_part_texel(part + 3), point, normal);
    } else {
      vec4 range = nook_world_part_texel(part + 1);
      int from = int(range.x), to = from + NOOK_CASTER_TEXELS * int(range.y);
      for (int k = from; k < to; k += NOOK_CASTER_TEXELS) open *= nook_world_caster_open(k, point, normal);
    }
  }
  return open;
}

// Returns true if a body reduces AO by less than the cut-off. `bound` is the combined number in the body's
// first texel. The gap to the body's sphere is the distance of its centre minus its radius. `top` is the
// height of the sphere's highest point above the horizon.
bool nook_world_out_of_reach(float bound, float distance, float height) {
  float radius = bound < NOOK_ENDLESS_BOUND ? fract(bound) * NOOK_LARGEST_RADIUS : NOOK_ENDLESS_BOUND;
  float gap = distance - radius, top = height + radius;
  // The casters cover at most strength / gap^2, weighted by the cosine of their directions, which is at most
  // top / gap.
  return top < 0.0 || (gap > 0.0 && bound * min(top, gap) < NOOK_STRENGTH_STEPS * gap * gap * gap);
}

// Near and far bodies are blended. Returns the weight of a body as a far body, from 0 to 1. `ratio` is the
// body's squared distance, divided by the squared distance beyond which one capsule replaces the body.
float nook_world_far_share(float ratio) {
  return clamp((ratio - NOOK_FAR_FROM) / (1.0 - NOOK_FAR_FROM), 0.0, 1.0);
}

float nook_world_whole_open(int body_texel, vec3 point, vec3 normal) {
  return nook_world_merged_open(nook_texel(nook_world_casters, body_texel + 2),
                                nook_texel(nook_world_casters, body_texel + 3), point, normal);
}

float nook_world_body_open(int body, vec3 point, vec3 normal) {
  int texel = NOOK_BODY_TEXELS * body;
  vec4 bound = nook_texel(nook_world_casters, texel);
  vec3 d = bound.xyz - point;
  float distance2 = dot(d, d);
  ++nook_world_tested;
  if (nook_world_out_of_reach(bound.w, sqrt(distance2), dot(d, normal))) return 1.0;
  vec4 parts = nook_texel(nook_world_casters, texel + 1);
#if NOOK_BODIES != NOOK_ALL_BODIES
  float far = nook_world_far_share(distance2 / parts.z);
  nook_world_weight = nook_world_far_bodies ? far : 1.0 - far;
  if (nook_world_weight == 0.0) return 1.0;
  if (nook_world_far_bodies) return nook_world_whole_open(texel, point, normal);
#endif
#if NOOK_BODIES == NOOK_FAR_BODIES
  return 1.0;
#else
  int first = int(parts.x), last = first + NOOK_PART_TEXELS * int(parts.y);
#if NOOK_BODIES == NOOK_ALL_BODIES
  if (distance2 > parts.z) return nook_world_whole_open(texel, point, normal);
#endif
  return nook_world_parts_open(first, last, point, normal);
#endif
}

float nook_world_open(vec3 point, vec3 normal) {
  float open = 1.0;
  for (int body = 0; body < nook_world_groups; ++body) open *= nook_world_body_open(body, point, normal);
  return open;
}
