/* The bakers as a library, nook_bake: what all of its headers share. nook_bake_character.h imports characters
 * and bakes them, nook_bake_material.h, nook_bake_synthesis.h and nook_bake_transfer.h bake materials,
 * planes of them and radiance transfer, and nook_bake_trace.h gives ray-traced references.
 *
 * nook_bake is for offline use. It links Embree, oneTBB and other libraries, and the runtime library, nook,
 * never needs it. Its results are the bytes of .nook files, which nook_character_model_load,
 * nook_material_load, nook_synthesis_load and nook_transfer_load take. Thread contracts, descriptors and
 * results follow the rules of nook.h; the messages of this library are in nook_bake_last_message(). */
#ifndef NOOK_BAKE_H
#define NOOK_BAKE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_bake_job_s* nook_bake_job;

/* Returns the message of this thread's latest failure in this library, as nook_last_message() does for the
 * runtime.
 * Any thread. */
NOOK_API const char* nook_bake_last_message(void);

/* Returns the version of this library, which compares with NOOK_VERSION.
 * Any thread. */
NOOK_API uint32_t nook_bake_version(void);

/* ---- Jobs: bakes on threads of their own; any number may run at once ---- */

/* The stage of a job. */
enum {
  NOOK_BAKE_STAGE_WAITING = 0,
  /* Ray tracing; done and total count poses of a character, views of a material, or vertices of radiance
   * transfer. */
  NOOK_BAKE_STAGE_RAYTRACE = 1,
  NOOK_BAKE_STAGE_INITIALISE = 2,
  /* The fit; done and total count steps. */
  NOOK_BAKE_STAGE_FIT = 3,
  /* The fit of how spheres darken other instances. */
  NOOK_BAKE_STAGE_CASTERS = 4,
  /* The job finished, failed or was cancelled; nook_bake_job_wait returns its result at once. */
  NOOK_BAKE_STAGE_DONE = 5,
  /* Compression of a material's BTF and VOTF; done and total count steps. */
  NOOK_BAKE_STAGE_BTF = 6,
  NOOK_BAKE_STAGE_VOTF = 7,
  /* The view map, which follows each of the two. */
  NOOK_BAKE_STAGE_VIEW_MAP = 8,
  /* The search for a material's relief, and the views that are moved to it, before the compression; done and
   * total count steps of the search, and then those views. */
  NOOK_BAKE_STAGE_RELIEF = 9
};
typedef int32_t nook_bake_stage;

typedef struct nook_bake_progress {
  /* sizeof(nook_bake_progress); the caller of nook_bake_job_poll sets it. */
  uint32_t struct_size;
  nook_bake_stage stage;
  uint64_t done;
  uint64_t total;
} nook_bake_progress;

/* Receives the progress of a job and returns 0 to cancel it. The job calls it on its own threads, one call at
 * a time, and never after nook_bake_job_wait or nook_bake_job_destroy has returned. It must not wait for or
 * destroy its own job. */
typedef int32_t (*nook_bake_progress_fn)(void* user, const nook_bake_progress* progress);

/* Gives the stage of a job and its progress.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_job_poll(nook_bake_job job, nook_bake_progress* progress);

/* Requests that the job stop soon and returns at once; a finished job stays as it is.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_job_cancel(nook_bake_job job);

/* Waits until the job ends and returns its result; it may be called any number of times.
 * Any thread. Errors: INVALID_ARGUMENT, CANCELLED, OUT_OF_MEMORY, INTERNAL. */
NOOK_API nook_result nook_bake_job_wait(nook_bake_job job);

/* Gives the bytes of the .nook file, which are valid until the job is destroyed.
 * Any thread. Errors: INVALID_ARGUMENT (the job is not finished), or the result of a job that failed. */
NOOK_API nook_result nook_bake_job_model(nook_bake_job job, const void** bytes, size_t* size);

/* Gives the report, a JSON object with the settings, times, errors and the curve of the fit. The text is
 * valid until the job is destroyed.
 * Any thread. Errors: those of nook_bake_job_model. */
NOOK_API nook_result nook_bake_job_report(nook_bake_job job, const char** json);

/* Destroys a job and sets *job to NULL. A job that still runs is cancelled, and the call waits for its end.
 * One at a time. */
NOOK_API void nook_bake_job_destroy(nook_bake_job* job);

#ifdef __cplusplus
}
#endif
#endif
