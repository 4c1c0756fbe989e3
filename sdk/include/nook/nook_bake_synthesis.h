/* Bakes of coordinate textures as jobs, which nook_bake.h follows and ends: a plane of any size that wears a
 * material without visible repeats, though the material may not even tile. */
#ifndef NOOK_BAKE_SYNTHESIS_H
#define NOOK_BAKE_SYNTHESIS_H

#include "nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A material and the settings of its synthesis. docs/synthesis.md describes the method. */
typedef struct nook_bake_synthesis_desc {
  /* nook_bake_synthesis_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* The bytes of a .nook file: a material, or a raw material that `nook bake material --keep-raw` wrote. It
   * has 16 texels or more along each side. nook_bake_synthesis_start reads it before it returns. */
  const void* material;
  size_t material_size;
  /* The part of the material that the plane may show, in texels: x, y, width, height. All 0 (default): the
   * whole. */
  uint32_t crop[4];
  /* 1 (default): the material tiles without a seam, and the plane may go on across its border. 0: it does
   * not. A crop never tiles. */
  uint32_t is_tiling;
  /* Texels along a side of the plane, which repeats after them: a multiple of 64 up to 4096; default 512. The
   * file has 4 bytes for each texel. */
  uint32_t side;
  /* Random movement, 0 to 1; default 0.8. More of it repeats less and has more seams. */
  float jitter;
  /* Corrections at each level, 1 to 16; default 8. */
  uint32_t passes;
  /* Default 1. The same seed gives the same bytes on any number of threads. */
  uint64_t seed;
  /* Default 0: all cores; up to 1024. */
  uint32_t threads;
  /* Must be 0. */
  uint32_t reserved;
  /* NULL (default): the host polls instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_synthesis_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_synthesis_desc_init(nook_bake_synthesis_desc* desc, size_t size,
                                                   uint32_t header_version);

/* Checks the descriptor, reads the material, starts to bake and returns at once. nook_bake_job_model gives
 * the bytes for nook_synthesis_load. The report holds the sizes, the time and the seams. On failure *out is
 * NULL. Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), VERSION, BAD_FILE (of
 * material), FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_synthesis_start(const nook_bake_synthesis_desc* desc, nook_bake_job* out);

#ifdef __cplusplus
}
#endif
#endif
