/* Lets models and clips come and go while frames run, so that no frame waits for them. Without this
 * streaming mode, nook_gl_scene_prepare and nook_gl_scene_update upload the data of a new model at once,
 * which takes milliseconds for a large one.
 *
 * Load models and clips on any thread (nook_model_load, nook_clips_load). Put the scene into streaming mode
 * once, while your game loads. Then call these each frame on the context thread:
 *
 *   nook_gl_scene_prepare_within  uploads for a limited time
 *   nook_gl_scene_update          evaluates the instances that are ready, and no others
 *
 * An instance that you add is pending: its AO is 1, and it darkens no other instance. nook_gl_scene_view
 * gives a view of ones, and nook_gl_scene_read and nook_gl_scene_write read ones. When its model and clips
 * are uploaded, the next update evaluates the instance and gives it another view. So compare
 * nook_gl_stream_info.generation with its last value, and ask for the views again if it changed. Until you
 * do, your old view still shows ones. But nook_scene_set_model ends a view: after the next
 * nook_gl_scene_prepare_within, do not draw with it. An instance that is ready and gets other clips keeps its
 * AO, and darkens no other instance, until the clips are uploaded. nook_gl_scene_read_pool returns the views
 * of many instances, with a generation for each (nook_gl_poses.h; is_near is 0 for a pending instance).
 *
 * No call waits for the GPU. They query OpenGL only if nook_gl_desc.state_mode or nook_gl_desc.debug requires
 * it. So without nook_gl_desc.debug, only your own glGetError tells you that OpenGL has no memory for an
 * upload. nook_gl_scene_update allocates only if you added instances or lights after the last
 * nook_gl_scene_prepare_within.
 *
 * A scene holds 1,048,575 instances. The id of an instance names a slot, and each slot is used for 4,096
 * instances, one after another. Then the slot stays empty and keeps its memory, about 800 bytes, until you
 * destroy the scene. */
#ifndef NOOK_STREAMING_H
#define NOOK_STREAMING_H

#include "../nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a scene is streamed. */
typedef struct nook_gl_stream_desc {
  /* sizeof(nook_gl_stream_desc). */
  uint32_t struct_size;
  /* The AO of a new instance fades from 1 to its value over this number of updates, at most 2,047. With 0 or
   * 1, the first update gives the final AO. While an instance fades, each update evaluates it. */
  uint32_t fade_updates;
  /* The number of instances that the scene will have at the same time, or 0. Nook reserves host memory for
   * them, so that adding them does not move the others. */
  uint32_t instance_count;
} nook_gl_stream_desc;

/* What is left to do. */
typedef struct nook_gl_stream_info {
  uint32_t struct_size;
  /* Instances whose model or clips are not uploaded yet. */
  uint32_t pending_count;
  /* Another number after a view of the scene changed. */
  uint32_t generation;
} nook_gl_stream_info;

/* Puts a scene into streaming mode for this nook_gl, or changes fade_updates. It compiles all shaders that
 * the scene may need, which takes some time, so call it while your game loads. nook_gl_scene_release ends the
 * mode; after the OpenGL context is lost, call it with the new nook_gl. nook_gl_scene_prepare still works: it
 * uploads everything at once, as you want it behind a loading screen. Poses on the GPU
 * (nook_gl_scene_set_poses) of a pending instance are lost; set them again when it is ready.
 * NOOK_POSE_FLAG_PARTIAL is refused there. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the scene
 * has a pool), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_set_streaming(nook_gl gl, nook_scene scene,
                                                 const nook_gl_stream_desc* desc);

/* Uploads models and clips of pending instances in small pieces, and releases those that no instance uses any
 * more, until `budget_us` microseconds are over. It does at least one piece of work, so 0 also makes
 * progress. The arrays of all pending instances of a model are one piece, so add large groups over several
 * frames. It may exceed the budget by the time of one piece, and of a pass over the scene's instances if
 * you added or removed some. `info` may be NULL. Context thread. Errors: INVALID_ARGUMENT (also: the scene is
 * not in streaming mode), GL, UNSUPPORTED (a model is too large for this OpenGL), OUT_OF_MEMORY. After an
 * error, the next call goes on. */
NOOK_API nook_result nook_gl_scene_prepare_within(nook_gl gl, nook_scene scene, uint32_t budget_us,
                                                  nook_gl_stream_info* info);

#ifdef __cplusplus
}
#endif
#endif
