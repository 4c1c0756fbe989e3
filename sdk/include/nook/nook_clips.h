/* Crowds without bones on the CPU. `nook bake clips` ray traces a character in every frame of its clips. It
 * stores two low-rank tables: the AO of each vertex, and the pose of each bone, which Nook needs for the
 * occlusion that the character casts on others. At run time, the CPU only needs the clip, the time and the
 * place of each character. Between two frames, Nook interpolates linearly. Call nook_scene_set_clip to play a
 * clip on an instance of a scene. Neighbours, ground, occluders and world capsules work as for a character
 * with bones. The AO is AO of the clip * (1 - added). `added` is the occlusion by neighbours, ground and
 * occluders, which the update evaluates at key points in the pose of the clip. On the GPU,
 * nook_gl_scene_update writes 1 - added to the buffers of such an instance. Your vertex shader decodes the AO
 * of the clip (nook_gl.h) and multiplies it by 1 - added. If the CPU updates the scene instead, turn off
 * NOOK_TERM_SELF with nook_scene_set_terms (experimental/nook_debug.h); nook_scene_read then gives 1 - added.
 */
#ifndef NOOK_CLIPS_H
#define NOOK_CLIPS_H

#include "nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Loads clips from the bytes of a .nook file, which you may free afterwards. `model` is the model that the
 * clips were baked with, a new bake of the same character, or a model that nook_model_remap made from one of
 * these. The clips keep the model alive. The library validates all bytes, so you can load files that you do
 * not trust. On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT (also if the clips belong to
 * another character), BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_clips_load(nook_context context, nook_model model, const void* bytes, size_t size,
                                     nook_clips* out);

/* Releases your reference and sets *clips to NULL; scenes that use the clips keep them alive. Any thread. */
NOOK_API void nook_clips_destroy(nook_clips* clips);

typedef struct nook_clips_info {
  uint32_t struct_size;
  uint32_t clip_count;
  /* The number of frames of all clips together. */
  uint32_t frame_count;
  /* The number of AO modes, a multiple of 4. The AO of a vertex in a frame is a weighted sum of its modes. */
  uint32_t mode_count;
  uint32_t pose_mode_count;
  /* The numbers of vertices and bones of the model. */
  uint32_t file_vertex_count;
  uint32_t bone_count;
  uint32_t reserved;
  /* Bytes of host memory, without the model. */
  uint64_t memory_bytes;
} nook_clips_info;

/* Describes the clips. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_describe(nook_clips clips, nook_clips_info* info);

typedef struct nook_clip_info {
  uint32_t struct_size;
  /* Frame first_frame + i is the pose at duration_s * i / (frame_count - 1); one frame if duration_s is 0. */
  uint32_t first_frame;
  uint32_t frame_count;
  float duration_s;
  /* Valid while the clips live. */
  const char* name;
} nook_clip_info;

/* Describes a clip. Clips are sorted by name, in byte order. To find a clip, compare all names once. Any
 * thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_describe_clip(nook_clips clips, uint32_t clip, nook_clip_info* info);

/* What happens at times outside a clip. */
enum {
  /* The time is clamped to the clip. */
  NOOK_CLIP_CLAMP = 0,
  /* The time is taken modulo the duration. The clip's last frame should be equal to its first frame. */
  NOOK_CLIP_LOOP = 1
};
typedef int32_t nook_clip_wrap;

typedef struct nook_clip_time {
  uint32_t clip;
  nook_clip_wrap wrap;
  /* Seconds from the clip's first frame, finite. */
  double seconds;
} nook_clip_time;

/* Finds the two frames between which a time lies, for your shader (nook_gl.h). `frames` are indices over the
 * frames of all clips. `share`, in [0, 1), is the second frame's weight. Any thread. Errors:
 * INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_frames(nook_clips clips, const nook_clip_time* time, uint32_t frames[2],
                                       float* share);

/* Writes the AO of the character alone at a time of a clip, in the order of nook_scene_read. `count` must be
 * the model's file_vertex_count; `stride` is in bytes (0: tightly packed). The call does not allocate.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_read_ao(nook_clips clips, const nook_clip_time* time, nook_format format,
                                        void* out, uint32_t count, size_t stride);

/* Writes the pose at a time of a clip: matrices of the kind NOOK_POSE_REST_TO_WORLD in the layout
 * NOOK_TRANSFORM_ROWS_3X4. `place_3x4` transforms the clip's space (metres) to world space, by a rotation, a
 * uniform scale and a translation. NULL means that the pose stays in the clip's space. Matrices are
 * interpolated linearly between two frames. So halfway between, a bone that turns by an angle is scaled by
 * the cosine of half this angle. The call does not allocate. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_clips_read_pose(nook_clips clips, const nook_clip_time* time,
                                          const float* place_3x4, float* bones_3x4, uint32_t bone_count);

/* Sets the pose of an instance from a clip, as nook_clips_read_pose gives it; `place_3x4` may be NULL. Until
 * the next call of nook_scene_set_pose or nook_scene_set_model, the self-occlusion of the instance also
 * comes from the clip. nook_scene_read then gives the AO of the clip times the share that the other casters
 * leave open: 1 - added, or a share for each channel of directional AO. The buffers of nook_gl_scene_update
 * hold only this share. You must have loaded the clips for the instance's model. The call does not allocate.
 * One at a time. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_set_clip(nook_scene scene, nook_instance_id instance, nook_clips clips,
                                         const nook_clip_time* time, const float* place_3x4);

#ifdef __cplusplus
}
#endif
#endif
