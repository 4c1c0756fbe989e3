/* Bakes of compressed materials as jobs, which nook_bake.h follows and ends, from a built-in meso-structure
 * or from measured data. */
#ifndef NOOK_BAKE_MATERIAL_H
#define NOOK_BAKE_MATERIAL_H

#include "nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The compression of a material (Tsai and Shih, TOG 2012). */
enum {
  /* K-clustered tensor approximation. */
  NOOK_BAKE_METHOD_K_CTA = 0,
  /* Clustered tensor approximation: each view has one cluster. */
  NOOK_BAKE_METHOD_CTA = 1,
  /* N-mode singular value decomposition: one cluster. */
  NOOK_BAKE_METHOD_N_SVD = 2,
  /* A small network over features of the texels, which trains for minutes; its VOTF is that of K-CTA. It is
   * the better one on flat and glossy materials, see docs/materials.md. Ranks are those of the VOTF. */
  NOOK_BAKE_METHOD_NEURAL = 3
};
typedef int32_t nook_bake_method;

/* The relief on which views are aligned before the compression, so that the views between them are sharper;
 * docs/materials.md has the errors with it and without. Where it predicts no view better, the material has
 * none. */
enum {
  NOOK_BAKE_RELIEF_NONE = 0,
  /* Heights on which the views agree. */
  NOOK_BAKE_RELIEF_ESTIMATED = 1,
  /* The heights of meso, or those of nook_bake_material_desc.heights. */
  NOOK_BAKE_RELIEF_KNOWN = 2
};
typedef int32_t nook_bake_relief;

/* A material and the settings of its compression. Directions are unit vectors in tangent space that point
 * away from the surface, z >= 0, and no two directions of a set may be equal. docs/materials.md describes
 * materials and what ranks cost. The limits are 1024 directions of a kind, 1024 texels along a side, and 6
 * GiB of floats. */
typedef struct nook_bake_material_desc {
  /* nook_bake_material_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* "fiber", "roughhole" or "weave", a built-in structure that is ray traced. NULL: btf holds measured
   * data. */
  const char* meso;
  /* light_count x view_count x height x width x RGB, of which RGB varies fastest; row 0 is at v = 0. The
   * values are finite linear radiances of what the view meets, for an irradiance of 1 on a plane that faces
   * the light. NULL with meso. nook_bake_material_start copies the array. */
  const float* btf;
  /* view_count x height x width: the share of a texel that the view meets, in [0, 1]. Colours where it is 0
   * are not read. The mask of the VOTF is 1 where the share is at least 0.5. NULL: the share is 1 everywhere,
   * and there is no VOTF. NULL with meso. nook_bake_material_start copies the array. */
  const float* coverage;
  /* 3 floats for each direction, at least 1e-3 apart; z >= 0, and with meso z >= 0.08 (85 degrees).
   * nook_bake_material_start copies the array. NULL, which needs meso: a spiral down to max_tilt_degrees. */
  const float* lights;
  /* View directions, in the same form as lights. */
  const float* views;
  /* Default 100. */
  uint32_t light_count;
  /* Default 100. */
  uint32_t view_count;
  /* Texels, default 96. */
  uint32_t width;
  /* Texels, default 96. */
  uint32_t height;
  /* The largest angle of the spirals from the normal, in degrees; default 75. */
  float max_tilt_degrees;
  /* For meso: view rays along the side of a texel; default 2. */
  uint32_t samples;
  /* For meso: diffuse interreflections; default 2. */
  uint32_t bounces;
  /* For meso: rays from each vertex for interreflections; default 64. */
  uint32_t bounce_rays;
  /* Default K_CTA. */
  nook_bake_method method;
  /* A nook_material_visibility: 0 for no VOTF, 1 for masks, 2 (default) for signed distances. */
  int32_t visibility;
  /* Ranks of the BTF's modes. If all four are 0 (default), a built-in structure has the ranks of
   * docs/materials.md, and measured data have the ranks that rank_threshold gives. rank_view is the sum over
   * the clusters. */
  uint32_t rank_light;
  uint32_t rank_view;
  uint32_t rank_x;
  uint32_t rank_y;
  /* Ranks of the VOTF's spatial modes. Both 0 (default): those of the BTF. */
  uint32_t votf_rank_x;
  uint32_t votf_rank_y;
  /* The view rank of one cluster; default 4. */
  uint32_t cluster_rank_view;
  /* Default 0: rank_view / cluster_rank_view. */
  uint32_t clusters;
  /* K, the number of clusters that a view mixes; default 3. */
  uint32_t mixture;
  /* The side in cells of the resampled view maps of K-CTA; default 64. 0: there is none, and decoding mixes
   * the three nearest views, for up to three times the work. */
  uint32_t view_map_side;
  /* The squared error that the choice of ranks allows in each mode, relative to the squared norm; default
   * 0.01. */
  float rank_threshold;
  /* Threshold and weight of the visibility mapping, equation (26). Both 0 (default): 0.5 and 1 for masks;
   * half a texel and the reciprocal of that for distances, for which the paper has 0.05 and 12. */
  float visibility_threshold;
  float visibility_weight;
  /* Default 0: all cores. */
  uint32_t threads;
  /* Default 1. The same seed gives the same bytes on any number of threads. */
  uint64_t seed;
  /* NULL (default): the host polls instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
  /* Of a number: 8 (default) for integers in the file and in textures, or 16 for half floats, which take
   * twice the room for about 0.1 dB. */
  uint32_t bits;
  /* Default NONE. */
  nook_bake_relief relief;
  /* height x width, row 0 at v = 0: heights over the plane of the texels in tiles, -1 to 1, for RELIEF_KNOWN
   * of measured data. nook_bake_material_start copies the array. NULL (default): not known. */
  const float* heights;
  /* For NEURAL: channels of the features, a multiple of 4 up to 64; default 16. */
  uint32_t neural_channels;
  /* For NEURAL: steps of the training, 1 to 1000000; default 8000. */
  uint32_t neural_steps;
} nook_bake_material_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_material_desc_init(nook_bake_material_desc* desc, size_t size,
                                                  uint32_t header_version);

/* Checks the descriptor, copies its arrays, starts to bake and returns at once. Faults that only the data
 * show, such as ranks that exceed the sizes, fail here as well. nook_bake_job_model gives the material's
 * file. The report holds the settings, sizes, times, the signal-to-error ratio in dB and the share of wrong
 * texels. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_material_start(const nook_bake_material_desc* desc, nook_bake_job* out);

#ifdef __cplusplus
}
#endif
#endif
