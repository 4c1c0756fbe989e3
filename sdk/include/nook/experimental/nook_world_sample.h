/* The CPU's reference of the world pass: AO and light that a scene's bodies leave at points of the world. */
#ifndef NOOK_WORLD_SAMPLE_H
#define NOOK_WORLD_SAMPLE_H

#include "../nook_clips.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A caster of a model, in rest space. */
typedef struct nook_model_capsule {
  nook_capsule capsule;
  uint32_t bone;
  /* AO uses the capsule's radii times this scale, > 0. */
  float ao_scale;
} nook_model_capsule;

/* Copies the world casters of a model. *count is the room in `out`, and becomes the number of the model's;
 * with out NULL only that is written. Any thread. Errors: INVALID_ARGUMENT (there is too little room),
 * UNSUPPORTED (the model was baked without; its instances then cast nothing, and *count becomes 0). */
NOOK_API nook_result nook_model_read_capsules(nook_model model, nook_model_capsule* out, uint32_t* count);

typedef struct nook_world_sample_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Three floats for each point, in world space and metres, and a normal of unit length. A point or normal
   * that is not finite is left open. */
  const float* positions;
  const float* normals;
  uint32_t point_count;
  /* Bytes from one point to the next, in both arrays; a multiple of 4, default 0: 12. */
  uint32_t stride;
  /* Casters besides the scene's; default none. */
  const nook_capsule* capsules;
  uint32_t capsule_count;
  /* The instance that the points belong to, which does not cast on them; default 0: every instance casts. */
  nook_instance_id receiver;
  /* The light: towards it, of unit length, and the full angle of its cone in degrees, more than 0, less than
   * 179. Default 0 degrees: no light. */
  float light_axis[3];
  float light_degrees;
  /* The light whose open share directional_ao gets: at most NOOK_PROBE_MAX_FUNCTIONS lobes in world space;
   * default none. The light of a small sun is better left out of them, and given as a cone. */
  const nook_lobe* lobes;
  uint32_t lobe_count;
  /* NULL (default), or room for three floats for each point: the open share of the lobes' light in red, green
   * and blue, in [0, 1]. It takes the place of AO in albedo / pi * E * AO, E the irradiance of the same
   * lobes. */
  float* directional_ao;
} nook_world_sample_desc;
static inline nook_result nook_world_sample_desc_init(nook_world_sample_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_SAMPLE, desc, sizeof *desc, NOOK_VERSION);
}

/* Computes at each point the AO that the casters leave, in [0, 1], and the open share of the light, for
 * lightmaps, particles and whatever a pass cannot see. scene may be NULL if only desc->capsules cast. It uses
 * the poses of the last nook_scene_set_pose; you need not call nook_scene_update. ao and light have room for
 * point_count floats; either may be NULL. An occluder with a receiver casts on that receiver only.
 *
 * A body is left out of a block of points if it takes less AO than the scene's cutoff_error from any of them:
 * (sum over its casters of r (r + 2 l / pi)) / d^2, with the radii r in AO, the lengths l, and the distance d
 * between the spheres round both. What is left out of a point is at most cutoff_error for each body. Free
 * occluders and desc->capsules are never left out.
 *
 * The call does not allocate, and runs through the context's parallel_for if the scene has one. One at a
 * time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_world_sample(nook_scene scene, const nook_world_sample_desc* desc, float* ao,
                                       float* light);

/* Poses the capsules that nook_model_read_capsules gives at a time of a clip, and writes them in world space.
 * They are for the field capsules of nook_world_sample_desc and nook_world_frame_desc, where no scene holds
 * the character. *count is the room in `out`, and becomes the number of the model's; with out NULL only that
 * is written. The radii are the ones for AO. Any thread. Errors: INVALID_ARGUMENT (also, there is too little
 * room), UNSUPPORTED (the model was baked without; *count becomes 0). */
NOOK_API nook_result nook_clips_read_capsules(nook_clips clips, const nook_clip_time* time,
                                              const float* place_3x4, nook_capsule* out, uint32_t* count);

#ifdef __cplusplus
}
#endif
#endif
