/* The bakers as a library, nook_bake, for offline use. It imports a character and bakes its model, bent
 * normals and clips, and it bakes materials. Each bake is a job: fill a descriptor, start the job, wait for
 * it, and get the bytes of a .nook file. The runtime loads this file. experimental/nook_bake_materials.h
 * declares the bakes of texture synthesis and radiance transfer, and experimental/nook_trace.h ray traces
 * reference values. nook_bake links Embree, oneTBB and other libraries; the runtime does not need nook_bake.
 * The rules of nook.h apply here too, but error messages come from nook_bake_last_message(). */
#ifndef NOOK_BAKE_H
#define NOOK_BAKE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fills a descriptor. Call the typed functions instead. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_desc_init(uint32_t type, void* desc, size_t size, uint32_t header_version);

/* Like nook_last_message(), but for failures in this library. Any thread. */
NOOK_API const char* nook_bake_last_message(void);

/* ---- Jobs: each bake runs on its own threads; any number of jobs may run in parallel ----
 *
 * Every bake descriptor has four fields for its job. `seed` is 1 by default; the same seed gives the same
 * bytes with any number of threads. `threads` is 0 by default, which means all cores; the maximum is 1024.
 * `progress` is a callback, or NULL (default) if you poll instead; `progress_user` is its first argument. */

/* The state of a job. */
enum {
  NOOK_BAKE_WAITING = 0,
  NOOK_BAKE_RUNNING = 1,
  /* The job finished, failed or was cancelled; nook_bake_job_wait returns its result without waiting. */
  NOOK_BAKE_DONE = 2
};
typedef int32_t nook_bake_state;

typedef struct nook_bake_progress {
  uint32_t struct_size;
  nook_bake_state state;
  /* The current stage in English, such as "ray tracing"; not NULL, valid while the library is loaded. */
  const char* stage;
  /* Steps of this stage, completed and total. A step is a pose, view, vertex, texel or fit iteration. */
  uint64_t done, total;
} nook_bake_progress;

/* Receives the progress of a job. Return 0 to cancel the job. The job calls this function on its own threads,
 * one call at a time, and not after nook_bake_job_wait or nook_bake_job_destroy has returned. Do not wait for
 * the job in this function. */
typedef int32_t (*nook_bake_progress_fn)(void* user, const nook_bake_progress* progress);

/* Starts a bake and returns immediately. The descriptor's `type` selects the kind of bake; if you know the
 * kind, call a typed function such as nook_bake_start_character instead. The call checks the descriptor and
 * copies its data, so you may free its arrays and destroy its character afterwards. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), BAD_FILE (`model` is not a model,
 * or belongs to another character), FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_start(const void* desc, nook_bake_job* out);

/* Gives the state of a job and its progress. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_job_poll(nook_bake_job job, nook_bake_progress* progress);

/* Asks the job to stop, and returns immediately. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_job_cancel(nook_bake_job job);

/* Waits until the job ends and returns its result. You may call it any number of times.
 * Any thread. Errors: INVALID_ARGUMENT, CANCELLED, OUT_OF_MEMORY, INTERNAL. */
NOOK_API nook_result nook_bake_job_wait(nook_bake_job job);

/* Gives the bytes of the .nook file, which are valid until the job is destroyed.
 * Any thread. Errors: INVALID_ARGUMENT (the job is not finished), or the error of a failed job. */
NOOK_API nook_result nook_bake_job_file(nook_bake_job job, const void** bytes, size_t* size);

/* Gives the report, a JSON object with settings, sizes, times and errors, valid until the job is destroyed.
 * Any thread. Errors: those of nook_bake_job_file. */
NOOK_API nook_result nook_bake_job_report(nook_bake_job job, const char** json);

/* Cancels a running job and waits for its end, destroys it and sets *job to NULL. One at a time. */
NOOK_API void nook_bake_job_destroy(nook_bake_job* job);

/* ---- Characters: immutable; a job keeps its character alive ----
 *
 * Pose matrices are of the kind NOOK_POSE_REST_TO_WORLD: one row-major 3x4 matrix for each bone, from rest
 * space to world space in metres. Vertices are in the order of the imported file, one imported primitive
 * after another (`nook inspect FILE` lists them). The runtime's AO has the same order. */

/* Where a rigged character comes from. Set exactly one source: `path` (a .glb or .gltf file), `bytes` (the
 * contents of such a file), or the arrays (`positions` and the fields after it, in the rest pose and in
 * metres). The import copies what it needs. */
typedef struct nook_bake_source_desc {
  uint32_t struct_size, type;
  const void* next;
  /* UTF-8. The file may use other files in its folder, or anywhere if allow_outside_files is 1. */
  const char* path;
  /* The contents of the file, with all buffers inside the file. */
  const void* bytes;
  size_t byte_count;
  /* 3 floats for each vertex, in metres; and 3 vertex indices for each triangle. */
  const float* positions;
  const uint32_t* indices;
  /* `influences` bone indices and weights >= 0 for each vertex; the import normalises the weights. */
  const uint16_t* joints;
  const float* weights;
  uint32_t vertex_count, index_count;
  /* Default 4. The import keeps the 8 largest weights of each vertex. */
  uint32_t influences;
  uint32_t bone_count;
  /* If NULL, the names are bone_0, bone_1 and so on. */
  const char* const* bone_names;
  /* The index of each bone's parent, or -1 for a root. A parent must come before its children. */
  const int32_t* bone_parents;
  /* Joint frames in rest space, 12 floats for each bone: orthonormal axes, with the origin at the joint. */
  const float* bone_frames_3x4;
  /* The vertices of each primitive, in order and without gaps. If NULL, one primitive holds all vertices. */
  const nook_range* primitives;
  uint32_t primitive_count;
  /* Names of nodes or meshes to import (`meshes`) or to skip (`without`); * and ? are wildcards. By default,
   * the import takes all visible meshes except LOD1, LOD2 and so on. */
  const char* const* meshes;
  const char* const* without;
  uint32_t mesh_count, without_count;
  int32_t allow_outside_files;
} nook_bake_source_desc;
static inline nook_result nook_bake_source_desc_init(nook_bake_source_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_SOURCE, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a character. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), BAD_FILE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_create(const nook_bake_source_desc* desc, nook_bake_character* out);

/* Releases your reference and sets *character to NULL; *character may be NULL. Any thread. */
NOOK_API void nook_bake_character_destroy(nook_bake_character* character);

typedef struct nook_bake_character_info {
  uint32_t struct_size;
  /* The number of vertices after welding: vertices that the file splits at seams count once. */
  uint32_t vertex_count;
  /* The number of vertices of the imported primitives. */
  uint32_t file_vertex_count;
  /* The number of triangles. The import drops degenerate triangles, so they are not counted. */
  uint32_t triangle_count;
  uint32_t bone_count, clip_count, primitive_count;
  /* The number of import warnings. A warning tells what the import left out or repaired. */
  uint32_t warning_count;
  /* The bounding box of the rest pose, in metres. */
  float bounds_min[3], bounds_max[3];
} nook_bake_character_info;

/* Describes a character. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_describe(nook_bake_character character,
                                                  nook_bake_character_info* info);

/* The kinds of names of a character. */
enum {
  NOOK_BAKE_NAME_BONE = 0,
  NOOK_BAKE_NAME_CLIP = 1,
  NOOK_BAKE_NAME_PRIMITIVE = 2,
  NOOK_BAKE_NAME_WARNING = 3
};
typedef int32_t nook_bake_name;

/* Returns a name, valid while the character lives, or NULL for an unknown kind or index. Any thread. */
NOOK_API const char* nook_bake_character_name(nook_bake_character character, nook_bake_name kind,
                                              uint32_t index);

/* The arrays of a character. Arrays over vertices have file_vertex_count entries, in file order. */
enum {
  /* int32_t for each bone: the index of its parent, or -1 for a root. */
  NOOK_BAKE_ARRAY_PARENTS = 0,
  /* 12 floats for each bone: its joint frame in rest space, a 3x4 matrix. */
  NOOK_BAKE_ARRAY_FRAMES = 1,
  /* nook_range for each primitive: its vertices. */
  NOOK_BAKE_ARRAY_PRIMITIVES = 2,
  /* 3 floats for each vertex: its rest position in metres. */
  NOOK_BAKE_ARRAY_POSITIONS = 3,
  /* 3 floats for each vertex: its unit normal, area-weighted over the welded surface. */
  NOOK_BAKE_ARRAY_NORMALS = 4,
  /* 3 uint32_t for each triangle, indices of vertices. At seams, all triangles use the first of the split
   * vertices. This is correct for AO and positions, but not for texture coordinates. */
  NOOK_BAKE_ARRAY_TRIANGLES = 5,
  /* 4 uint16_t for each vertex: the bones with the largest weights, in descending order. */
  NOOK_BAKE_ARRAY_JOINTS = 6,
  /* 4 floats for each vertex: the weights of these bones, whose sum is 1. */
  NOOK_BAKE_ARRAY_WEIGHTS = 7
};
typedef int32_t nook_bake_array;

/* Writes an array. `count` must be the number of entries: of bones, primitives, vertices or triangles.
 * `stride` is in bytes (0: tightly packed). Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read(nook_bake_character character, nook_bake_array array, void* out,
                                              uint32_t count, size_t stride);

/* Gives the length of a clip in seconds. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_clip_duration(nook_bake_character character, uint32_t clip,
                                                       float* seconds);

/* Writes the pose of a clip at `time_s`. The time is in seconds from the first key, clamped to the clip. Here
 * and below, `bone_count` must be the character's bone count. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_sample_clip(nook_bake_character character, uint32_t clip,
                                                     float time_s, float* bones_3x4, uint32_t bone_count);

/* Writes `pose_count` generated whole-body poses with `bone_count` matrices each. The same seed gives the
 * same poses. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_auto_poses(nook_bake_character character, uint64_t seed,
                                                    uint32_t pose_count, float* bones_3x4,
                                                    uint32_t bone_count);

/* Skins the character by linear blend skinning with all weights. Writes positions in the world (metres) and
 * area-weighted unit normals, 3 floats for each vertex in file order; either array may be NULL.
 * Any thread. Errors: INVALID_ARGUMENT (a count is wrong, or a matrix is not finite). */
NOOK_API nook_result nook_bake_character_skin(nook_bake_character character, const float* bones_3x4,
                                              uint32_t bone_count, float* positions, float* normals,
                                              uint32_t vertex_count);

/* ---- The bake of a character's model ---- */

/* The effort of a bake; the times are for two cores. */
enum {
  /* About 20 s. */
  NOOK_BAKE_PRESET_DRAFT = 0,
  /* Up to 5 minutes and 2 GB of memory. */
  NOOK_BAKE_PRESET_STANDARD = 1,
  /* Up to half an hour. Compared with STANDARD, it uses nearly four times the poses, twice the rays, and up
   * to 800 key points instead of 500. A scene update then takes about 20 % longer. */
  NOOK_BAKE_PRESET_PRODUCTION = 2
};
typedef int32_t nook_bake_preset;

/* The poses that a model is fitted to. */
enum {
  /* Generated whole-body poses, which need no clip. */
  NOOK_BAKE_POSES_AUTO = 0,
  /* For comparisons only: poses that rotate a single joint, on a grid over +-45 degrees. */
  NOOK_BAKE_POSES_SINGLE_JOINT = 1,
  /* The character's clips. */
  NOOK_BAKE_POSES_CLIPS = 2,
  /* The poses of AUTO and CLIPS, and as many variants (mirrored, mixed, blended) as there are clip poses. */
  NOOK_BAKE_POSES_ALL = 3,
  /* Only the poses in extra_poses_3x4. */
  NOOK_BAKE_POSES_EXTRA = 4
};
typedef int32_t nook_bake_pose_mode;

/* With this `gamma`, the bake tries several exponents and keeps the one with the lowest error on held-out
 * poses. The runtime has fast paths for 1, 1.5 and 2; other exponents take two to four times as long. */
#define NOOK_BAKE_GAMMA_LEARNED (-1.0f)

/* The value of `saturation` that turns saturation off. */
#define NOOK_BAKE_UNSATURATED (-1.0f)

typedef struct nook_bake_character_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_bake_character_study_desc of experimental/nook_trace.h. */
  const void* next;
  nook_bake_character character;
  /* Default STANDARD. Each count from `spheres` to `samples_per_clip` that is 0 gets the preset's value. */
  nook_bake_preset preset;
  /* The maximum number of proxy spheres, up to 1024, and of key points, up to 4096. */
  uint32_t spheres, key_points;
  /* Rays per vertex and pose for the ray-traced AO that the model is fitted to, up to 65,536. */
  uint32_t rays;
  /* Steps of the fit, up to 10,000,000. */
  uint32_t steps;
  /* Default ALL. For a character without clips, ALL is the same as AUTO. */
  nook_bake_pose_mode pose_mode;
  /* The number of generated poses of AUTO and ALL. With ALL, the default is reduced by the number of
   * clip-pose variants, at most by half. */
  uint32_t auto_pose_count;
  /* The number of poses of each clip. */
  uint32_t samples_per_clip;
  /* The number of names in clip_names. 0: the bake uses every clip with motion (not a T-pose or A-pose). */
  uint32_t clip_count;
  uint32_t extra_pose_count;
  /* The clips to use. If a name is unknown, the bake fails, and the message lists the character's clips. */
  const char* const* clip_names;
  /* Poses to add to the poses of pose_mode, with bone_count matrices each. The call copies them. */
  const float* extra_poses_3x4;
  uint64_t seed;
  uint32_t threads;
  /* NOOK_FORM_DEFAULT (default) uses a smooth horizon, a fall-off with the exact power of distance, and a fit
   * by mini-batches. NOOK_FORM_PAPER uses the kernel and the block coordinate descent of Le et al. 2019. */
  nook_form form;
  /* The exponent of the shadow norm, 1 to 8, or NOOK_BAKE_GAMMA_LEARNED. Default 0: 1, or 2 with
   * NOOK_FORM_PAPER. */
  float gamma;
  /* The initial value of c in the shadow of a key point, n / (1 + c n). Here n is the norm over the spheres;
   * n alone would be too dark where many spheres overlap. The fit changes c. The maximum is 64. 0 (default)
   * means 0.5 with the default form and a gamma of 1, and no saturation otherwise. NOOK_BAKE_UNSATURATED
   * turns saturation off; other values need the default form and a gamma of 1. */
  float saturation;
  /* The time limit of the fit in seconds. A fit that reaches it is not reproducible. Default 0: no limit. */
  double time_limit_s;
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_character_desc;
static inline nook_result nook_bake_character_desc_init(nook_bake_character_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_CHARACTER, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts to bake a character's model for nook_model_load. See nook_bake_start. */
static inline nook_result nook_bake_start_character(const nook_bake_character_desc* desc,
                                                    nook_bake_job* out) {
  return nook_bake_start(desc, out);
}

/* ---- Bent normals ----
 *
 * Each vertex gets two vectors that describe which directions the body occludes. The bake computes these
 * vectors by ray tracing in some poses of the model (docs/character.md). */

typedef struct nook_bake_bent_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The character of the model. */
  nook_bake_character character;
  /* The bytes of the character's baked model. The bake replaces the bent normals of this model. */
  const void* model;
  size_t model_size;
  /* Rays for each vertex and pose, 1 to 65,536; default 128. */
  uint32_t rays;
  /* The number of generated poses, 8 to 100,000; default 48. */
  uint32_t auto_pose_count;
  /* Poses per clip, 1 to 100,000; default 3. The bake uses the clips that the model was fitted to, or every
   * clip with motion if the model does not contain the recipe of its bake. */
  uint32_t samples_per_clip;
  uint32_t threads;
  uint64_t seed;
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_bent_desc;
static inline nook_result nook_bake_bent_desc_init(nook_bake_bent_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_BENT, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts to bake bent normals. The result is a model file for nook_model_load: the given model with bent
 * normals. See nook_bake_start. */
static inline nook_result nook_bake_start_bent(const nook_bake_bent_desc* desc, nook_bake_job* out) {
  return nook_bake_start(desc, out);
}

/* ---- Clips ----
 *
 * The bake stores the ray-traced AO and the pose of every frame of a character's clips in a small table
 * (nook_clips.h, docs/character.md). Crowds drawn from this table need no bones on the CPU. */

typedef struct nook_bake_clips_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The character, and the bytes of its baked model. */
  nook_bake_character character;
  const void* model;
  size_t model_size;
  /* The clips to bake. If NULL (default), the bake uses every clip with motion (not a T-pose or A-pose). */
  const char* const* clip_names;
  uint32_t clip_count;
  /* Rays for each vertex and frame, 1 to 65,536; default 128. */
  uint32_t rays;
  /* Frames per second, 0.1 to 1000; default 30. All clips together have at most 2^20 frames. */
  float frames_per_second;
  /* The root mean square AO error over vertices and frames that the bake aims for, 1e-4 to 1; default 0.015.
   * The bake stores as many AO modes (basis vectors) as it needs for this error. */
  float max_error;
  /* The maximum bytes per frame and vertex, 1e-4 to 100; default 0.25. Modes over this limit are dropped. */
  float max_bytes;
  /* The maximum number of AO modes, a multiple of 4 from 4 to 256; default 96. */
  uint32_t max_modes;
  uint64_t seed;
  uint32_t threads;
  uint32_t reserved;
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_clips_desc;
static inline nook_result nook_bake_clips_desc_init(nook_bake_clips_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_CLIPS, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts to bake the clips of a character for nook_clips_load. If a clip name is unknown, the message lists
 * the clips. See nook_bake_start. */
static inline nook_result nook_bake_start_clips(const nook_bake_clips_desc* desc, nook_bake_job* out) {
  return nook_bake_start(desc, out);
}

/* ---- Materials: the bake compresses a built-in meso-structure or measured data ---- */

/* The compression of a material (Tsai and Shih, TOG 2012). */
enum {
  /* K-clustered tensor approximation. */
  NOOK_BAKE_METHOD_K_CTA = 0,
  /* Clustered tensor approximation: each view has one cluster. */
  NOOK_BAKE_METHOD_CTA = 1,
  /* N-mode singular value decomposition: one cluster. */
  NOOK_BAKE_METHOD_N_SVD = 2,
  /* Experimental: a small neural network that reads features of the texels. It trains for minutes, and is
   * better than the other methods on flat and glossy materials (docs/materials.md). It compresses the VOTF
   * (view-dependent occlusion, see nook_material.h) by K-CTA, and the rank fields apply only to the VOTF. */
  NOOK_BAKE_METHOD_NEURAL = 3
};
typedef int32_t nook_bake_method;

/* A material and its compression. Directions are unit vectors in tangent space that point away from the
 * surface, z >= 0. All light directions must be different, and so must all view directions. nook_bake_start
 * copies all arrays. The limits are 1024 light and 1024 view directions, 1024 texels along a side, and 6 GiB
 * of floats. docs/materials.md describes the cost of ranks. */
typedef struct nook_bake_material_desc {
  uint32_t struct_size, type;
  const void* next;
  /* A built-in structure to ray trace: "fiber", "roughhole" or "weave". If NULL, `btf` is used instead. */
  const char* meso;
  /* light_count x view_count x height x width x RGB, where RGB varies fastest; row 0 is at v = 0. Pass finite
   * linear radiances towards the view, for irradiance 1 on a plane that faces the light. Must be NULL with
   * `meso`. */
  const float* btf;
  /* view_count x height x width: the fraction of each texel's area in which this view sees the material, in
   * [0, 1]. Where it is 0, the bake does not read colours. The VOTF's mask is 1 where the fraction is at
   * least 0.5. If `coverage` is NULL, the fraction is 1 everywhere and there is no VOTF. Must be NULL with
   * `meso`. */
  const float* coverage;
  /* 3 floats for each direction. Directions must be at least 1e-3 apart; with `meso`, z must be >= 0.08 (85
   * degrees from the normal). If NULL (only with `meso`), a spiral up to max_tilt_degrees is used. */
  const float* lights;
  const float* views;
  /* The numbers of light directions and of view directions; default 100 each. */
  uint32_t light_count, view_count;
  /* The size of the tile in texels; default 96 x 96. */
  uint32_t width, height;
  /* The spirals contain directions up to this angle from the normal; default 75. */
  float max_tilt_degrees;
  /* Only for `meso`: view rays along the side of a texel, default 2; the number of diffuse bounces, default
   * 2; and rays per vertex for the bounces, default 64. */
  uint32_t samples, bounces, bounce_rays;
  /* Default K_CTA. */
  nook_bake_method method;
  /* Default NOOK_FORM_DEFAULT. NOOK_FORM_PAPER uses half floats, no view map, no relief, and the visibility
   * mapping of Tsai and Shih; it ignores `bits` and `view_map_side`, and `relief` must be 0. */
  nook_form form;
  /* A value of nook_material_visibility: 0 for no VOTF, 1 for masks, 2 (default) for signed distances. */
  int32_t visibility;
  /* Ranks of the BTF's modes; rank_view is the sum over the clusters. If all are 0 (default), a built-in
   * structure gets the ranks of docs/materials.md; for measured data, rank_threshold determines the ranks. */
  uint32_t rank_light, rank_view, rank_x, rank_y;
  /* Ranks of the VOTF's spatial modes. If both are 0 (default), the VOTF has the spatial ranks of the BTF. */
  uint32_t votf_rank_x, votf_rank_y;
  /* The view rank of one cluster, default 4; and the number of clusters. If `clusters` is 0 (default), there
   * are rank_view / cluster_rank_view clusters. */
  uint32_t cluster_rank_view, clusters;
  /* K, the number of clusters that each view is mixed from; default 3. */
  uint32_t mixture;
  /* Cells along the side of the resampled view maps of K-CTA; default 64. With 0 there are no view maps, and
   * a decoder mixes the three nearest views, which takes up to three times the work. */
  uint32_t view_map_side;
  /* When the bake chooses ranks, it allows this squared error per mode, relative to the squared norm of the
   * data. Default 0.01. */
  float rank_threshold;
  /* Threshold and weight of the visibility mapping, equation (26). If both are 0 (default), they are 0.5 and
   * 1 for masks, and half a texel and its reciprocal for distances (0.05 and 12 with NOOK_FORM_PAPER). */
  float visibility_threshold, visibility_weight;
  uint32_t threads;
  uint64_t seed;
  nook_bake_progress_fn progress;
  void* progress_user;
  /* 8 (default): 8-bit integers in file and textures. 16: half floats, twice the size, 0.1 dB better. */
  uint32_t bits;
  /* 1: views are aligned by a relief (a height map), so that interpolated views are sharper
   * (docs/materials.md). The relief comes from `heights` or `meso`; otherwise the bake finds the relief on
   * which the views agree best. If the relief does not improve the prediction of views, the material gets
   * none. 0 (default): no relief. */
  uint32_t relief;
  /* Known heights of measured data, for the relief: height x width values, row 0 at v = 0, from -1 to 1. They
   * are relative to the plane of the texels, in units of a tile's size. NULL (default): not known. */
  const float* heights;
  /* Only for NEURAL: the number of feature channels, a multiple of 4 up to 64, default 16; and the number of
   * training steps, 1 to 1000000, default 8000. */
  uint32_t neural_channels, neural_steps;
} nook_bake_material_desc;
static inline nook_result nook_bake_material_desc_init(nook_bake_material_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_MATERIAL, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts to bake a material for nook_material_load. The call fails if the data has faults, such as ranks that
 * exceed the sizes. The report contains the signal-to-error ratio in dB, and the share of texels whose
 * visibility is wrong. See nook_bake_start. */
static inline nook_result nook_bake_start_material(const nook_bake_material_desc* desc, nook_bake_job* out) {
  return nook_bake_start(desc, out);
}

#ifdef __cplusplus
}
#endif
#endif
