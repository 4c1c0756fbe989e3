/* Characters darken the world: AO and the soft shadow of one light on what is not their own, from casters.
 *
 * A world caster is a capsule, the convex hull of two spheres, that is rigid to one bone. `nook bake
 * character` fits at most 64 of them to each body against ray tracing, on floors, on walls and on neighbours,
 * and stores them in the model's file. The instances of a scene (nook_character.h) cast with them, and so do
 * the scene's free occluders, as spheres, and props, which are capsules that the host places.
 *
 * AO: the share of a point's cosine-weighted hemisphere that a capsule covers has a closed form, exact where
 * the capsule is above the horizon. Casters overlap by the product of what each leaves open, as if they
 * covered the hemisphere independently; a caster counts in it with ao_scale times its radii, which the bake
 * fits. Light: a cone of directions is cut into NOOK_WORLD_CONE_PARTS equal parts. In each the product of
 * what the casters leave open counts, and the light's open share is the mean over the parts. Casters that
 * cover different parts thus add, and those that cover one part whole darken it once.
 *
 * Light by channel: under lobes a caster that covers the share f of the hemisphere takes f rho of the light,
 * with rho for each channel the mean radiance behind it over that of the hemisphere. With AO the product over
 * the casters, the open share is 1 - (1 - AO) R, R the mean of rho over the casters by their shares. A shadow
 * thus falls away from a window and takes its colour from what is left. The lobes count by their bands 0
 * to 2, and 24 or more lobes by bands 0 to 4. Under constant light the open share is AO.
 *
 * nook_gl_world.h darkens what a depth buffer shows. */
#ifndef NOOK_WORLD_H
#define NOOK_WORLD_H

#include "nook_character.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_WORLD_MAX_CASTERS 64
#define NOOK_WORLD_CONE_PARTS 16

/* A capsule: every point that is within the radius of the segment from a to b, which changes evenly from
 * radius_a to radius_b. A sphere has equal ends. Metres. */
typedef struct nook_world_capsule {
  float a[3];
  float radius_a;
  float b[3];
  float radius_b;
} nook_world_capsule;

/* A caster of a model, in rest space. */
typedef struct nook_world_caster {
  nook_world_capsule capsule;
  uint32_t bone;
  /* The radii in AO over those of the capsule, > 0. */
  float ao_scale;
} nook_world_caster;

/* Copies the world casters of a model. *count is the room in `out`, and becomes the number of the model's;
 * with out NULL only that is written. Any thread. Errors: INVALID_ARGUMENT (there is too little room),
 * UNSUPPORTED (the model was baked without; its instances then cast nothing, and *count becomes 0). */
NOOK_API nook_result nook_world_read_casters(nook_character_model model, nook_world_caster* out,
                                             uint32_t* count);

typedef struct nook_world_sample_desc {
  /* nook_world_sample_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Three floats for each point, in world space and metres, and a normal of unit length. A point or normal
   * that is not finite is left open. */
  const float* positions;
  const float* normals;
  uint32_t point_count;
  /* Bytes from one point to the next, in both arrays; a multiple of 4, default 0: 12. */
  uint32_t stride;
  /* Casters besides the scene's; default none. */
  const nook_world_capsule* props;
  uint32_t prop_count;
  /* The instance that the points belong to, which does not cast on them; default 0: every instance casts. */
  nook_instance_id receiver;
  /* The light: towards it, of unit length, and the full angle of its cone in degrees, more than 0, less than
   * 179. Default 0 degrees: no light. */
  float light_axis[3];
  float light_degrees;
  /* The light whose open share directional_ao gets: at most NOOK_PROBE_MAX_FUNCTIONS lobes in world space;
   * default none. The light of a small sun is better left out of them, and given as a cone. */
  const nook_probe_lobe* lobes;
  uint32_t lobe_count;
  /* NULL (default), or room for three floats for each point: the open share of the lobes' light in red, green
   * and blue, in [0, 1]. It takes the place of AO in albedo / pi * E * AO, E the irradiance of the same
   * lobes. */
  float* directional_ao;
} nook_world_sample_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_world_sample_desc_init(nook_world_sample_desc* desc, size_t size,
                                                 uint32_t header_version);

/* Computes at each point the AO that the casters leave, in [0, 1], and the open share of the light, for
 * lightmaps, particles and whatever a pass cannot see. scene may be NULL where props alone cast. The poses
 * are those of the last nook_scene_set_pose; no nook_scene_update is needed. ao and light have room for
 * point_count floats; either may be NULL. An occluder that nook_scene_limit_occluder limits to an instance
 * casts on that receiver only.
 *
 * A body is left out of a block of points if it takes less AO than the scene's cutoff_error from any of them:
 * (sum over its casters of r (r + 2 l / pi)) / d^2, with the radii r in AO, the lengths l, and the distance d
 * between the spheres round both. What is left out of a point is at most cutoff_error for each body. Free
 * occluders and props are never left out.
 *
 * The call does not allocate, and runs through the context's parallel_for if the scene has one. One at a
 * time. Errors: INVALID_ARGUMENT, VERSION, INVALID_HANDLE. */
NOOK_API nook_result nook_world_sample(nook_scene scene, const nook_world_sample_desc* desc, float* ao,
                                       float* light);

#ifdef __cplusplus
}
#endif
#endif
