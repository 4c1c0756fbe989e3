/* Computes the ambient occlusion of many poses of one model in one call, for tools and pipelines. */
#ifndef NOOK_POSES_H
#define NOOK_POSES_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Evaluates `pose_count` poses of a single character, and writes the AO of each vertex in each pose to `ao`:
 * one pose after another, with file_vertex_count floats each. `count` must be pose_count * file_vertex_count.
 * The result is bit-identical to the AO of a scene with one instance, if you call nook_scene_set_pose,
 * nook_scene_update and nook_scene_read for each pose.
 *
 * `first` describes the first pose, as for nook_scene_set_pose; its kind, layout, place and bone map apply to
 * all poses. `pose_stride` is the number of bytes from the first transform of a pose to the first transform
 * of the next pose. It is a multiple of 4; 0 means that poses are tightly packed. With
 * NOOK_POSE_FLAG_PARTIAL, a bone without a transform stays in the rest pose. `plane_xyzd` is a ground under
 * all poses, as for nook_scene_set_ground, or NULL. `settings` may be NULL for the defaults of
 * nook_scene_desc_init.
 *
 * The call uses the context's parallel_for if there is one, and allocates. If a pose is invalid, the message
 * names the pose, and `ao` may contain part of the result.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (as nook_scene_set_pose), OUT_OF_MEMORY. */
NOOK_API nook_result nook_model_evaluate_poses(nook_model model, const nook_scene_desc* settings,
                                               const nook_pose_desc* first, uint32_t pose_count,
                                               size_t pose_stride, const float* plane_xyzd, float* ao,
                                               size_t count);

#ifdef __cplusplus
}
#endif
#endif
