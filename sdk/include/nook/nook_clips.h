/* Crowds without bones on the CPU: the AO and the poses of a character's clips, baked over frames. `nook bake
 * clips` ray traces a character in every frame of its clips. It stores two low-rank tables: the AO of each
 * vertex, and the pose of each bone for what the character casts on others. The CPU then needs only the clip,
 * the time and the place of each character. A time between two frames mixes their weights. Give such a clip
 * to an instance of a scene with nook_scene_set_clip. Neighbours, ground, occluders and world capsules work
 * as for a character with bones: AO = AO of the clip * (1 - added), where the added casters are evaluated at
 * key points in the pose of the clip. On the GPU, your vertex shader decodes the AO of the clip (nook_gl.h)
 * and multiplies it by 1 - added, which nook_gl_scene_update leaves in the buffers of such an instance. If
 * the CPU updates the scene instead, leave out NOOK_TERM_SELF by nook_scene_set_terms
 * (experimental/nook_debug.h): nook_scene_read then gives 1 - added. */
#ifndef NOOK_CLIPS_H
#define NOOK_CLIPS_H

#include "nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Loads clips from the bytes of a .nook file, which you may free afterwards. model is the one that they were
 * baked with, a new bake of the same character, or what nook_model_remap makes of one; the clips keep it
 * alive. The library validates everything, so that hostile bytes are safe. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also, the clips are another character's), BAD_FILE, FILE_VERSION,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_clips_load(nook_context context, nook_model model, const void* bytes, size_t size,
                                     nook_clips* out);

/* Releases your reference and sets *clips to NULL; scenes that use the clips keep them alive. Any thread. */
NOOK_API void nook_clips_destroy(nook_clips* clips);

typedef struct nook_clips_info {
  uint32_t struct_size;
  uint32_t clip_count;
  /* The frames of all clips. */
  uint32_t frame_count;
  /* The modes of AO, a multiple of 4. A vertex of a frame is a sum over them. */
  uint32_t mode_count;
  uint32_t pose_mode_count;
  /* The vertices and bones of the model. */
  uint32_t file_vertex_count;
  uint32_t bone_count;
  uint32_t reserved;
  /* Host memory without the model. */
  uint64_t memory_bytes;
} nook_clips_info;

/* Describes the clips. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_describe(nook_clips clips, nook_clips_info* info);

typedef struct nook_clip_info {
  uint32_t struct_size;
  /* Frame first_frame + i is the pose at duration_s * i / (frame_count - 1). A clip without duration has
   * one. */
  uint32_t first_frame;
  uint32_t frame_count;
  float duration_s;
  /* Valid while the clips live. */
  const char* name;
} nook_clip_info;

/* Describes a clip. Clips are in byte order of their names; to find one, compare the names of all once. Any
 * thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_describe_clip(nook_clips clips, uint32_t clip, nook_clip_info* info);

/* Times outside a clip. */
enum {
  /* The time is clamped to the clip. */
  NOOK_CLIP_CLAMP = 0,
  /* The time counts modulo the duration. The last frame is at the duration and should equal the first. */
  NOOK_CLIP_LOOP = 1
};
typedef int32_t nook_clip_wrap;

typedef struct nook_clip_time {
  uint32_t clip;
  nook_clip_wrap wrap;
  /* Seconds from the clip's first frame, finite. */
  double seconds;
} nook_clip_time;

/* Gives the two frames, counted over all clips, between which a time lies, and the share of the second in
 * [0, 1), for a shader: nook_gl.h. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_frames(nook_clips clips, const nook_clip_time* time, uint32_t frames[2],
                                       float* share);

/* Writes the AO of the character alone at a time of a clip, in the order of nook_scene_read. count must be
 * the model's file_vertex_count; stride is in bytes (0: tightly packed). The call does not allocate.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_read_ao(nook_clips clips, const nook_clip_time* time, nook_format format,
                                        void* out, uint32_t count, size_t stride);

/* Writes the pose at a time of a clip, NOOK_POSE_REST_TO_WORLD in NOOK_TRANSFORM_ROWS_3X4. place_3x4 maps the
 * clip's space, in metres, to the world: a rotation with one scale; NULL: the clip's space. Between two
 * frames a bone moves on a line, and one that turns by an angle shrinks by the cosine of half of it. The call
 * does not allocate. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_read_pose(nook_clips clips, const nook_clip_time* time,
                                          const float* place_3x4, float* bones_3x4, uint32_t bone_count);

/* Sets the pose of an instance from a clip, at a place as in nook_clips_read_pose, and takes its own AO from
 * the clip until the next nook_scene_set_pose or nook_scene_set_model. nook_scene_read then gives the AO of
 * the clip times what the added casters of the last update leave open, also for each channel of directional
 * AO. The buffers of nook_gl_scene_update have only the second factor. The clips must have been loaded for
 * the instance's model. It does not allocate. One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_clip(nook_scene scene, nook_instance_id instance, nook_clips clips,
                                         const nook_clip_time* time, const float* place_3x4);

#ifdef __cplusplus
}
#endif
#endif
