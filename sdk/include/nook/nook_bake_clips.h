/* Bakes of a character's clips as jobs, which nook_bake.h follows and ends: ray-traced AO and poses as a
 * small table over frames, for crowds that need no bones on the CPU (nook_clips.h). */
#ifndef NOOK_BAKE_CLIPS_H
#define NOOK_BAKE_CLIPS_H

#include "nook_bake.h"
#include "nook_bake_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The clips to bake and the size of their table. docs/character.md describes the method. */
typedef struct nook_bake_clips_desc {
  /* nook_bake_clips_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* The bytes of the character's baked model, a .nook file. nook_bake_clips_start reads it before it
   * returns. */
  const void* model;
  size_t model_size;
  /* The names of the clips to bake; NULL (default): every clip with motion. Clips whose name says T-pose or
   * A-pose have none. */
  const char* const* clip_names;
  /* The number of names; default 0. */
  uint32_t clip_count;
  /* Rays for each vertex and frame, 1 to 65,536; default 128. */
  uint32_t rays;
  /* Frames of each second of a clip, 0.1 to 1000; default 30. All clips together have at most 2^20 frames. */
  float frames_per_second;
  /* The file takes as many modes as this error needs: AO, root mean square over vertices and frames, 1e-4 to
   * 1; default 0.015. */
  float max_error;
  /* Bytes of the file for each frame and vertex, 1e-4 to 100; default 0.25. Modes beyond it are left out. */
  float max_bytes;
  /* Modes of AO, a multiple of 4 from 4 to 256; default 96. */
  uint32_t max_modes;
  /* Default 1. The same seed gives the same bytes on any number of threads. */
  uint64_t seed;
  /* Default 0: all cores; up to 1024. */
  uint32_t threads;
  /* Must be 0. */
  uint32_t reserved;
  /* NULL (default): the host polls instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_clips_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_clips_desc_init(nook_bake_clips_desc* desc, size_t size,
                                               uint32_t header_version);

/* Checks the descriptor, reads the model, starts to bake the clips of the character and returns at once. The
 * character may be destroyed before the job ends. nook_bake_job_model gives the bytes for nook_clips_load.
 * The report holds the sizes, the errors of the tables and the time. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT (the message names the first fault; an unknown clip's lists the clips of the
 * character), VERSION, BAD_FILE (no model, or that of another character), FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_clips_start(nook_bake_character character, const nook_bake_clips_desc* desc,
                                           nook_bake_job* out);

#ifdef __cplusplus
}
#endif
#endif
