/* Sets the clips of all instances of a crowd in one call. On the tiers NOOK_GL_TIER_43 and NOOK_GL_TIER_ES31
 * (nook_gl_info.tier), the CPU does no work per bone: Nook uploads the tables of the clips once, and a
 * compute shader decodes the bones. On other tiers, and in nook_scene_update, the CPU decodes the bones, as
 * nook_scene_set_clip does. So the call works on every tier, and also after the OpenGL context is lost.
 *
 * Each frame, call nook_scene_set_clips once for each nook_clips whose instances move, and then
 * nook_gl_scene_update. Your vertex shader decodes the AO of the clip, as after nook_scene_set_clip
 * (nook_clips.h). Otherwise, instances behave as after nook_scene_set_clip. Calls that need an instance's
 * bones on the CPU, such as nook_scene_read_key_points, decode the bones first. nook_world_render decodes
 * only the bones to which capsules are attached.
 *
 * Culling, the ground, neighbours and levels of detail use a bounding sphere of each body. The library
 * computes the sphere of each frame when it loads the clips. Between two frames, it interpolates their
 * spheres, and enlarges the radius because bones that turn do not move on straight lines. */
#ifndef NOOK_CLIP_CROWDS_H
#define NOOK_CLIP_CROWDS_H

#include "../nook_clips.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The clip, time and place of one instance. */
typedef struct nook_instance_clip {
  nook_instance_id instance;
  uint32_t reserved; /* 0 */
  nook_clip_time time;
  /* The 3x4 row-major matrix from the clip's space (metres) to world space: a rotation, a translation and a
   * scale that is uniform to 1 %. It may mirror. */
  float place_3x4[12];
} nook_instance_clip;

/* Sets clip, time and place of `count` different instances. On failure, no instance is changed. Instances
 * that you do not pass keep their poses. AO agrees with nook_scene_set_clip within 1e-5, root mean square
 * over a body. Between two frames, the bounding sphere of a body may be larger than after
 * nook_scene_set_clip, so updates may cull fewer casters. The call does not allocate and does not call
 * OpenGL. The next nook_gl_scene_prepare or nook_gl_scene_update allocates if an instance plays clips that
 * this nook_gl has not uploaded yet. One at a time. Errors: INVALID_ARGUMENT (as nook_scene_set_clip; also if
 * an instance occurs twice, or a place_3x4 scales unevenly), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_clips(nook_scene scene, nook_clips clips,
                                          const nook_instance_clip* instances, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
