/* Bent normals for a baked character as a job, which nook_bake.h follows and ends: for each vertex two
 * vectors of the directions that its body blocks, by ray tracing in a few poses. */
#ifndef NOOK_BAKE_BENT_H
#define NOOK_BAKE_BENT_H

#include "nook_bake.h"
#include "nook_bake_character.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The model and the poses that its bent normals are fitted to. docs/character.md describes the method. */
typedef struct nook_bake_bent_desc {
  /* nook_bake_bent_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* The bytes of the character's baked model, a .nook file. nook_bake_bent_start reads it before it returns.
   * Bent normals that it has give way to the new ones. */
  const void* model;
  size_t model_size;
  /* Rays for each vertex and pose, 1 to 65,536; default 128. */
  uint32_t rays;
  /* Generated poses, 8 to 100,000; default 48. */
  uint32_t auto_pose_count;
  /* Poses of each clip that the model was fitted to, 1 to 100,000; default 3. A model without a recipe takes
   * every clip with motion. */
  uint32_t samples_per_clip;
  /* Default 0: all cores; up to 1024. */
  uint32_t threads;
  /* Default 1. The same seed gives the same bytes on any number of threads. */
  uint64_t seed;
  /* NULL (default): the host polls instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_bent_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_bent_desc_init(nook_bake_bent_desc* desc, size_t size,
                                              uint32_t header_version);

/* Checks the descriptor, reads the model, starts to bake and returns at once. The character may be destroyed
 * before the job ends. nook_bake_job_model gives the bytes of the model with bent normals, all else in it
 * unchanged, for nook_character_model_load. The report holds the sizes and the time. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), VERSION, BAD_FILE (no model, or
 * that of another character), FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_bent_start(nook_bake_character character, const nook_bake_bent_desc* desc,
                                          nook_bake_job* out);

#ifdef __cplusplus
}
#endif
#endif
