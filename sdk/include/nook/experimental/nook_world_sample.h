/* The CPU reference of the world pass. It computes how much the bodies of a scene darken points in the world:
 * the AO, and the open share of a light. */
#ifndef NOOK_WORLD_SAMPLE_H
#define NOOK_WORLD_SAMPLE_H

#include "../nook_clips.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A capsule with which a model darkens the world, in rest space. */
typedef struct nook_model_capsule {
  nook_capsule capsule;
  uint32_t bone;
  /* AO uses the radii of the capsule times this scale, > 0. */
  float ao_scale;
} nook_model_capsule;

/* Copies the capsules with which a model darkens the world. Set *count to the capacity of `out`; the call
 * sets it to the number of capsules of the model. With `out` NULL, the call only sets *count. Any thread.
 * Errors: INVALID_ARGUMENT (the capacity is too small), UNSUPPORTED (the model was baked without capsules;
 * its instances then do not darken the world, and *count becomes 0). */
NOOK_API nook_result nook_model_read_capsules(nook_model model, nook_model_capsule* out, uint32_t* count);

typedef struct nook_world_sample_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Three floats for each point: the position in metres in world space, and the unit normal. If the position
   * or normal of a point is not finite, the point gets AO 1. */
  const float* positions;
  const float* normals;
  uint32_t point_count;
  /* Bytes from one point to the next in both arrays, a multiple of 4. The default 0 means 12. */
  uint32_t stride;
  /* Additional casters that are not in the scene; default none. */
  const nook_capsule* capsules;
  uint32_t capsule_count;
  /* The instance that the points belong to. This instance does not darken the points. Default 0: every
   * instance darkens the points. */
  nook_instance_id receiver;
  /* The unit vector towards the light, and the full angle of its cone in degrees, above 0 and below 179.
   * Default 0 degrees: no light. */
  float light_axis[3];
  float light_degrees;
  /* The light for directional_ao: at most NOOK_PROBE_MAX_FUNCTIONS lobes in world space; default none. For a
   * small sun, use light_axis instead of a lobe. */
  const nook_lobe* lobes;
  uint32_t lobe_count;
  /* NULL (default), or an array for three floats per point. It receives the open share of the lobes' light in
   * red, green and blue, in [0, 1]. Use it instead of AO in albedo / pi * E * AO, where E is the irradiance
   * of the same lobes. */
  float* directional_ao;
} nook_world_sample_desc;
static inline nook_result nook_world_sample_desc_init(nook_world_sample_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_SAMPLE, desc, sizeof *desc, NOOK_VERSION);
}

/* Computes the AO in [0, 1] and the open share of the light at each point. Use it for lightmaps, particles
 * and everything else that is not in the depth buffer of a pass. `scene` may be NULL if desc->capsules are
 * the only casters. The call uses the poses of the last nook_scene_set_pose; you need not call
 * nook_scene_update. `ao` and `light` receive point_count floats each; either may be NULL. An occluder with a
 * receiver darkens only this receiver.
 *
 * A body is skipped for a block of points if it darkens each of them by less than the scene's cutoff_error.
 * The bound of the darkening is (sum over the body's capsules of r (r + 2 l / pi)) / d^2. Here r is the
 * scaled radius and l the length of a capsule, and d is the distance between the bounding spheres of the body
 * and the block. So each skipped body changes the AO of a point by at most cutoff_error. Free occluders and
 * desc->capsules are never skipped.
 *
 * The call does not allocate. It uses the parallel_for of the scene's context, if there is one. One at a
 * time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_world_sample(nook_scene scene, const nook_world_sample_desc* desc, float* ao,
                                       float* light);

/* Poses the capsules of nook_model_read_capsules at a time of a clip, and writes them in world space. If the
 * character is not in a scene, pass the written capsules as `capsules` of nook_world_sample_desc and
 * nook_world_frame_desc. The radii include the scale for AO. Set *count to the capacity of `out`; the call
 * sets it to the number of capsules of the model. With `out` NULL, the call only sets *count. Any thread.
 * Errors: INVALID_ARGUMENT (also if the capacity is too small), UNSUPPORTED (the model was baked without
 * capsules; *count becomes 0). */
NOOK_API nook_result nook_clips_read_capsules(nook_clips clips, const nook_clip_time* time,
                                              const float* place_3x4, nook_capsule* out, uint32_t* count);

#ifdef __cplusplus
}
#endif
#endif
