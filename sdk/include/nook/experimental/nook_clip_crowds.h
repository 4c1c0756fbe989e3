/* The clips of a crowd in one call. The CPU does no work for a bone: where an update runs in compute shaders
 * (nook_gl_info.tier is NOOK_GL_TIER_43 or NOOK_GL_TIER_ES31), a shader decodes the bones, and the tables of
 * the clips are uploaded once. On other tiers and in nook_scene_update, the update decodes them on the CPU,
 * as nook_scene_set_clip does. So the call works everywhere, and also after a lost OpenGL context.
 *
 * Each frame, call nook_scene_set_clips once for each nook_clips whose instances move, and then
 * nook_gl_scene_update. Your vertex shader decodes the AO of the clip, as after nook_scene_set_clip
 * (nook_clips.h). Everything else works as for an instance of nook_scene_set_clip, too. Calls that need bones
 * on the CPU, such as nook_scene_read_key_points, decode the bones of the instance first. nook_world_render
 * decodes only bones that cast.
 *
 * Culling, the ground, neighbours and levels of detail follow a sphere around each body. The library computes
 * the sphere of each frame when it loads the clips. Between two frames it mixes their spheres, and adds how
 * far bones leave the line between their places.
 */
#ifndef NOOK_CLIP_CROWDS_H
#define NOOK_CLIP_CROWDS_H

#include "../nook_clips.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The clip of one instance. */
typedef struct nook_instance_clip {
  nook_instance_id instance;
  uint32_t reserved; /* 0 */
  nook_clip_time time;
  /* A 3x4 row-major matrix from the clip's space, in metres, to the world: a rotation with one scale, to 1 %.
   * It may mirror. */
  float place_3x4[12];
} nook_instance_clip;

/* Sets clip, time and place of `count` different instances. The call takes all or none. An instance that is
 * not in a call keeps its pose. AO agrees with nook_scene_set_clip within 1e-5, root mean square over a body.
 * Between two frames the sphere around the body may be larger than after nook_scene_set_clip. Then fewer
 * casters are culled.
 * The call does not allocate and does not call OpenGL. The next nook_gl_scene_prepare or nook_gl_scene_update
 * allocates if an instance has clips that this nook_gl does not know. One at a time. Errors: INVALID_ARGUMENT
 * (as nook_scene_set_clip; also: an instance occurs twice, a place is uneven), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_clips(nook_scene scene, nook_clips clips,
                                          const nook_instance_clip* instances, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
