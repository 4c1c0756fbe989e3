/* The bakers as a library, nook_bake: characters in from glTF or from memory, poses, materials from built-in structures or
 * from measurements, baking as jobs, ray-traced truth.
 *
 * Offline: nook_bake links Embree, oneTBB and more; the runtime library, nook, never needs it. What it makes are the bytes of
 * .nook files, which nook_character_model_load and nook_material_load take.
 *
 * Matrices of poses are those of nook_scene_set_pose: one 3x4 matrix per bone, row-major, rest space to world, metres.
 * Vertices are in the imported file's order, all primitives in a row, as the runtime gives their AO back. Contracts,
 * descriptors and results follow the rules of nook.h; messages of this library are in nook_bake_last_message(). */
#ifndef NOOK_BAKE_H
#define NOOK_BAKE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_bake_character_s* nook_bake_character;
typedef struct nook_bake_job_s* nook_bake_job;

/* The message of this thread's latest failure of this library, as nook_last_message(). Any thread. */
NOOK_API const char* nook_bake_last_message(void);

/* The version of this library, comparable to NOOK_VERSION. Any thread. */
NOOK_API uint32_t nook_bake_version(void);

/* ---- Characters: immutable; jobs that use one keep it alive ---- */

/* Imports a rigged character from a .glb or .gltf file. path is UTF-8. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT, BAD_FILE (the message names the file and the fault), OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_import_gltf(const char* path, nook_bake_character* out);

/* The same from bytes, which may be freed afterwards; no other file is read, so buffers must be inside. Any thread. */
NOOK_API nook_result nook_bake_import_gltf_bytes(const void* bytes, size_t size, nook_bake_character* out);

/* A run of vertices that belong together, such as one drawn part of a character. */
typedef struct nook_bake_primitive {
  uint32_t first_vertex;
  uint32_t vertex_count;
} nook_bake_primitive;

/* A character in memory, rest pose, metres. Arrays are read during nook_bake_character_create only. */
typedef struct nook_bake_mesh_desc {
  uint32_t struct_size;                  /* set by nook_bake_mesh_desc_init */
  uint32_t header_version;               /* set by nook_bake_mesh_desc_init */
  const void* next;                      /* NULL */
  const float* positions;                /* 3 a vertex */
  const uint32_t* indices;               /* 3 a triangle */
  const uint16_t* joints;                /* influences a vertex: indices of bones */
  const float* weights;                  /* the same; >= 0, normalised on import */
  uint32_t vertex_count;
  uint32_t index_count;                  /* a multiple of 3 */
  uint32_t influences;                   /* default 4; the 8 largest of each vertex are kept */
  uint32_t bone_count;
  const char* const* bone_names;         /* NULL: bone_0, bone_1, ... */
  const int32_t* bone_parents;           /* smaller than the bone's own index; -1: a root */
  const float* bone_frames_3x4;          /* joint frames in rest space: orthonormal axes, origin at the joint */
  const nook_bake_primitive* primitives; /* NULL: one that holds everything; otherwise in order and without gaps */
  uint32_t primitive_count;
} nook_bake_mesh_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_mesh_desc_init(nook_bake_mesh_desc* desc, size_t size, uint32_t header_version);

/* On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT (names the first fault), OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_create(const nook_bake_mesh_desc* desc, nook_bake_character* out);

/* Sets *character to NULL; NULL is fine, and so are jobs that still run. Any thread. */
NOOK_API void nook_bake_character_destroy(nook_bake_character* character);

typedef struct nook_bake_character_info {
  uint32_t struct_size;       /* sizeof(nook_bake_character_info), set by the caller */
  uint32_t vertex_count;      /* welded: split vertices of seams count once */
  uint32_t file_vertex_count; /* all primitives in a row */
  uint32_t triangle_count;    /* of area; degenerate ones are dropped */
  uint32_t bone_count;
  uint32_t clip_count;
  uint32_t primitive_count;
  uint32_t warning_count;     /* what the import left out or repaired */
  float bounds_low[3];        /* rest pose, metres */
  float bounds_high[3];
} nook_bake_character_info;

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_describe(nook_bake_character character, nook_bake_character_info* info);

/* Texts of a character, valid while it lives; NULL for an index out of range. Any thread. */
NOOK_API const char* nook_bake_character_bone_name(nook_bake_character character, uint32_t bone);
NOOK_API const char* nook_bake_character_clip_name(nook_bake_character character, uint32_t clip);
NOOK_API const char* nook_bake_character_primitive_name(nook_bake_character character, uint32_t primitive);
NOOK_API const char* nook_bake_character_warning(nook_bake_character character, uint32_t warning);

/* Parents (-1: a root) and rest frames of all bones; either array may be NULL. bone_count must be the character's. Any thread.
 * Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_bones(nook_bake_character character, int32_t* parents, float* frames_3x4,
                                                    uint32_t bone_count);

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_describe_primitive(nook_bake_character character, uint32_t primitive,
                                                       nook_bake_primitive* out);

/* Length of a clip in seconds. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_clip_duration(nook_bake_character character, uint32_t clip, float* seconds);

/* The pose of a clip; time is in seconds from its first key, clamped to its length. bone_count must be the character's.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_sample_clip(nook_bake_character character, uint32_t clip, float time_s,
                                                     float* bones_3x4, uint32_t bone_count);

/* pose_count plausible whole-body poses, one after the other; the same seed gives the same poses. bones_3x4 holds
 * pose_count * bone_count matrices. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_auto_poses(nook_bake_character character, uint64_t seed, uint32_t pose_count,
                                                    float* bones_3x4, uint32_t bone_count);

/* Each joint that moves some but not all vertices, alone, on a grid of steps^3 rotations over +-range_degrees. *pose_count
 * becomes the number of poses; with bones_3x4 NULL nothing else happens, otherwise *pose_count must come in as that number.
 * Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_single_joint_poses(nook_bake_character character, uint32_t steps,
                                                            float range_degrees, uint32_t* pose_count, float* bones_3x4,
                                                            uint32_t bone_count);

/* Rest positions and normals, 3 floats a vertex in file order; either may be NULL. Normals are area-weighted over the welded
 * surface. vertex_count must be file_vertex_count. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_vertices(nook_bake_character character, float* positions, float* normals,
                                                       uint32_t vertex_count);

/* Triangles as indices of file-order vertices. Where vertices were split at a seam, all triangles round it use the first of
 * them: right for drawing AO and shape, not for texture coordinates. index_count must be 3 * triangle_count. Any thread.
 * Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_triangles(nook_bake_character character, uint32_t* indices,
                                                        uint32_t index_count);

/* The four strongest bones of each file-order vertex and their weights (sum 1), strongest first. Any thread.
 * Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_skin(nook_bake_character character, uint16_t* joints, float* weights,
                                                   uint32_t vertex_count);

/* Linear blend skinning with all weights: world-space positions and area-weighted normals of a pose, 3 floats a vertex in file
 * order; either may be NULL. Any thread. Errors: INVALID_ARGUMENT (wrong counts, a matrix that is not finite). */
NOOK_API nook_result nook_bake_character_skin(nook_bake_character character, const float* bones_3x4, uint32_t bone_count,
                                              float* positions, float* normals, uint32_t vertex_count);

/* ---- Jobs: bakes that run on threads of their own; any number at once ---- */

enum {
  NOOK_BAKE_PRESET_DRAFT = 0,     /* about 20 s on two cores */
  NOOK_BAKE_PRESET_STANDARD = 1,  /* at most 5 minutes, 2 GB */
  NOOK_BAKE_PRESET_PRODUCTION = 2 /* about half an hour */
};
typedef int32_t nook_bake_preset;

enum {
  NOOK_BAKE_POSES_AUTO = 0,         /* generated whole-body poses; needs no clip */
  NOOK_BAKE_POSES_SINGLE_JOINT = 1, /* one joint at a time on a grid over +-45 degrees */
  NOOK_BAKE_POSES_CLIPS = 2,        /* the character's clips */
  NOOK_BAKE_POSES_ALL = 3,          /* auto and clips */
  NOOK_BAKE_POSES_EXTRA = 4         /* only extra_poses_3x4 */
};
typedef int32_t nook_bake_pose_mode;

enum {
  NOOK_BAKE_SPLIT_ALL = 0, /* every clip that shows motion (T- and A-poses, by name, do not) */
  NOOK_BAKE_SPLIT_HALF = 1, /* every second of them in byte order of the names, the first included: the others can measure */
  NOOK_BAKE_SPLIT_FAMILIES = 2 /* the same with families in place of clips: names alike up to the first underscore */
};
typedef int32_t nook_bake_clip_split;

enum {
  NOOK_BAKE_KERNEL_NOOK = 0,    /* smooth horizon, fall-off with the true power of distance */
  NOOK_BAKE_KERNEL_PAPER = 1,   /* Le et al. 2019, slide 18 */
  NOOK_BAKE_KERNEL_RATIONAL = 2 /* the paper's horizon, fall-off with the true power of distance */
};
typedef int32_t nook_bake_kernel;

enum {
  NOOK_BAKE_FIT_NOOK = 0, /* both layers at once by mini-batches */
  NOOK_BAKE_FIT_PAPER = 1 /* block coordinate descent with L-BFGS */
};
typedef int32_t nook_bake_fit;

enum {
  NOOK_BAKE_STAGE_WAITING = 0,
  NOOK_BAKE_STAGE_RAYTRACE = 1,   /* done and total count poses, of a material views */
  NOOK_BAKE_STAGE_INITIALISE = 2,
  NOOK_BAKE_STAGE_FIT = 3,        /* steps */
  NOOK_BAKE_STAGE_CASTERS = 4,    /* how spheres darken other instances */
  NOOK_BAKE_STAGE_DONE = 5,       /* finished, failed or cancelled: nook_bake_job_wait returns at once and tells which */
  NOOK_BAKE_STAGE_BTF = 6,        /* compressing a material: steps */
  NOOK_BAKE_STAGE_VOTF = 7,
  NOOK_BAKE_STAGE_VIEW_MAP = 8    /* after each of the two */
};
typedef int32_t nook_bake_stage;

typedef struct nook_bake_progress {
  uint32_t struct_size; /* sizeof(nook_bake_progress), set by the caller of nook_bake_job_poll */
  nook_bake_stage stage;
  uint64_t done;
  uint64_t total;
} nook_bake_progress;

/* Returns 0 to cancel. Comes from threads of the job, one call at a time, never after nook_bake_job_wait or
 * nook_bake_job_destroy has returned. It must not wait for or destroy its own job. */
typedef int32_t (*nook_bake_progress_fn)(void* user, const nook_bake_progress* progress);

/* Tries several exponents in short fits and takes the one with the least error on held-out poses. The runtime has fast paths
 * for 1, 1.5 and 2; others take two to four times as long. */
#define NOOK_BAKE_GAMMA_LEARNED (-1.0f)

typedef struct nook_bake_job_desc {
  uint32_t struct_size;              /* set by nook_bake_job_desc_init */
  uint32_t header_version;           /* set by nook_bake_job_desc_init */
  const void* next;                  /* NULL */
  nook_bake_preset preset;           /* default STANDARD; what is 0 below takes the preset's value */
  uint32_t spheres;                  /* proxy spheres at most; at most 1024 */
  uint32_t key_points;               /* at most; at most 4096 */
  uint32_t rays;                     /* a vertex and pose, of the ray-traced targets */
  uint32_t steps;                    /* of the fit */
  nook_bake_pose_mode pose_mode;     /* default ALL, which is AUTO for a character without clips */
  uint32_t auto_pose_count;          /* generated poses of AUTO and ALL */
  uint32_t samples_per_clip;         /* poses of each clip */
  uint32_t clip_count;               /* of clip_names; 0: the clips that clip_split chooses */
  const char* const* clip_names;     /* only these clips, by name; an unknown one fails and the message lists those there are */
  nook_bake_clip_split clip_split;   /* default ALL */
  uint32_t extra_pose_count;
  const float* extra_poses_3x4;      /* poses to be added to those of pose_mode, bone_count matrices each; copied */
  uint64_t seed;                     /* default 1; the same seed gives the same bytes on any number of threads */
  uint32_t threads;                  /* default 0: all cores */
  nook_bake_kernel kernel;           /* default NOOK */
  nook_bake_fit fit;                 /* default NOOK */
  float gamma;                       /* exponent of the shadow norm, 1 to 8, or NOOK_BAKE_GAMMA_LEARNED; default 0: 1 */
  double time_limit_s;               /* of the fit; default 0: none. A fit that it ends is not reproducible bit for bit */
  nook_bake_progress_fn progress;    /* NULL: poll instead */
  void* progress_user;
} nook_bake_job_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_job_desc_init(nook_bake_job_desc* desc, size_t size, uint32_t header_version);

/* Checks everything and begins to bake; returns at once. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_job_start(nook_bake_character character, const nook_bake_job_desc* desc,
                                         nook_bake_job* out);

/* Where the job is. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_job_poll(nook_bake_job job, nook_bake_progress* progress);

/* Asks the job to stop soon; a finished job stays as it is. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_job_cancel(nook_bake_job job);

/* Waits until the job is over and returns its result, any number of times. Any thread.
 * Errors: INVALID_ARGUMENT, CANCELLED, OUT_OF_MEMORY, INTERNAL. */
NOOK_API nook_result nook_bake_job_wait(nook_bake_job job);

/* The bytes of the .nook file, valid until the job is destroyed. Any thread.
 * Errors: INVALID_ARGUMENT (the job is not finished), or the result of a job that failed. */
NOOK_API nook_result nook_bake_job_model(nook_bake_job job, const void** bytes, size_t* size);

/* A JSON object: settings, times, errors, the curve of the fit. Valid until the job is destroyed. Any thread. Errors: as
 * nook_bake_job_model. */
NOOK_API nook_result nook_bake_job_report(nook_bake_job job, const char** json);

/* Cancels and waits if the job still runs; sets *job to NULL. One at a time. */
NOOK_API void nook_bake_job_destroy(nook_bake_job* job);

/* ---- Materials: jobs as above, from a built-in meso-structure or from measured data ---- */

enum {
  NOOK_BAKE_METHOD_K_CTA = 0, /* K-clustered tensor approximation */
  NOOK_BAKE_METHOD_CTA = 1,
  NOOK_BAKE_METHOD_N_SVD = 2
};
typedef int32_t nook_bake_method;

/* Directions are unit vectors in tangent space, away from the surface, z >= 0; no two of a set alike. What a material is, and what
 * ranks cost: docs/materials.md. Numbers are at most 1024 directions, 1024 texels a side and 6 GiB of floats. */
typedef struct nook_bake_material_desc {
  uint32_t struct_size;            /* set by nook_bake_material_desc_init */
  uint32_t header_version;         /* set by nook_bake_material_desc_init */
  const void* next;                /* NULL */
  const char* meso;                /* "fiber", "roughhole" or "weave", ray traced; NULL: btf is measured */
  const float* btf;                /* light_count x view_count x height x width x RGB, the last fastest; row 0 at v = 0.
                                      Linear radiance for an irradiance of 1 on a plane that faces the light, of what the
                                      view meets; finite. NULL with meso. Copied by nook_bake_material_start */
  const float* coverage;           /* view_count x height x width: the share of a texel that the view meets, 0 to 1; colours
                                      where it is 0 are not read. The mask of the VOTF is where it is 0.5 or more. NULL: all
                                      1, and no VOTF. NULL with meso. Copied */
  const float* lights;             /* 3 a direction; NULL only with meso: a spiral down to max_tilt_degrees. Copied.
                                      z >= 0, with meso 0.08 (85 degrees); 1e-3 apart or more */
  const float* views;              /* the same */
  uint32_t light_count;            /* default 100 */
  uint32_t view_count;             /* default 100 */
  uint32_t width;                  /* texels, default 96 */
  uint32_t height;                 /* default 96 */
  float max_tilt_degrees;          /* of the spirals, default 75 */
  uint32_t samples;                /* of meso: view rays along a texel's side, default 2 */
  uint32_t bounces;                /* of meso: diffuse inter-reflections, default 2 */
  uint32_t bounce_rays;            /* of meso: from each vertex, default 64 */
  nook_bake_method method;         /* default K_CTA */
  int32_t visibility;              /* a nook_material_visibility: 0 no VOTF, 1 masks, 2 (default) signed distances */
  uint32_t rank_light;             /* ranks of the BTF's modes; all four 0 (default): those of docs/materials.md for a built-in
                                      structure, else by threshold */
  uint32_t rank_view;              /* in total over the clusters */
  uint32_t rank_x;
  uint32_t rank_y;
  uint32_t votf_rank_x;            /* both 0 (default): as for the BTF */
  uint32_t votf_rank_y;
  uint32_t cluster_rank_view;      /* view rank of one cluster, default 4 */
  uint32_t clusters;               /* default 0: rank_view / cluster_rank_view */
  uint32_t mixture;                /* K, clusters that a view is mixed from, default 3 */
  uint32_t view_map_side;          /* cells of K-CTA's resampled view maps, default 256; 0: none, and decoding mixes the three
                                      nearest views, for up to three times the work */
  float rank_threshold;            /* squared error that ranks by threshold allow in each mode, a share of the square norm,
                                      default 0.01 */
  float visibility_threshold;      /* of the visibility mapping (26); both 0 (default): 0.5, 1 of masks; of distances half a
                                      texel and 1 over that. The paper has 0.05, 12 for these */
  float visibility_weight;
  uint32_t threads;                /* default 0: all cores */
  uint64_t seed;                   /* default 1; the same seed gives the same bytes on any number of threads */
  nook_bake_progress_fn progress;  /* NULL: poll instead */
  void* progress_user;
} nook_bake_material_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_material_desc_init(nook_bake_material_desc* desc, size_t size, uint32_t header_version);

/* Checks the arguments, copies the arrays and begins to bake. The job is one as those of characters: nook_bake_job_model
 * gives a material's file; the report has its recipe, sizes, times, signal-to-error ratio in dB and error texels. What only
 * the data tell, such as ranks that the sizes do not allow, is an error here too. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_material_start(const nook_bake_material_desc* desc, nook_bake_job* out);

/* ---- Ray-traced ambient occlusion of a scene ---- */

/* World space, metres. */
typedef struct nook_bake_occluder_mesh {
  const float* positions; /* 3 a vertex */
  const uint32_t* indices; /* 3 a triangle; both sides occlude */
  uint32_t vertex_count;
  uint32_t index_count;
} nook_bake_occluder_mesh;

typedef struct nook_bake_trace_desc {
  uint32_t struct_size;                  /* set by nook_bake_trace_desc_init */
  uint32_t header_version;               /* set by nook_bake_trace_desc_init */
  const void* next;                      /* NULL */
  const nook_bake_occluder_mesh* meshes; /* NULL only with mesh_count 0: everything is open */
  const float* positions;                /* receivers, 3 a point, world space */
  const float* normals;                  /* 3 a point, unit length to 1e-3 */
  uint32_t mesh_count;
  uint32_t point_count;
  uint32_t rays;                         /* a point, cosine-weighted; default 64 */
  uint32_t threads;                      /* default 0: all cores */
  uint64_t seed;                         /* default 1; the result does not depend on the number of threads */
  float radius;                          /* metres, > 0; longer rays count as open; default infinity */
  float origin_offset;                   /* metres along the normal, >= 0, default 1e-4 */
} nook_bake_trace_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_trace_desc_init(nook_bake_trace_desc* desc, size_t size, uint32_t header_version);

/* Writes point_count values to ao; count must be point_count. Returns when it is done. Any thread.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_trace_ao(const nook_bake_trace_desc* desc, float* ao, uint32_t count);

/* ---- Path-traced irradiance of a scene under an environment ---- */

/* A latitude-longitude map of linear radiance. Rows go from +y down to -y, columns once round y: the middle column looks along
 * +x, a quarter further right along +z. Radiance is constant over a texel. */
typedef struct nook_bake_environment {
  const float* rgb; /* 3 a texel, rows from the top; finite, 0 or above. NULL only with width 0: black */
  uint32_t width;   /* at most 16384 */
  uint32_t height;  /* at most 8192 */
} nook_bake_environment;

/* World space, metres. A diffuse surface, the same from both sides. */
typedef struct nook_bake_lit_mesh {
  const float* positions;  /* 3 a vertex */
  const uint32_t* indices; /* 3 a triangle */
  uint32_t vertex_count;
  uint32_t index_count;
  float base_colour[3];    /* RGB, the share of light that it sends back, 0 to 1; 0: it only occludes */
  float emission[3];       /* RGB, radiance of its own, 0 or above */
} nook_bake_lit_mesh;

typedef struct nook_bake_irradiance_desc {
  uint32_t struct_size;              /* set by nook_bake_irradiance_desc_init */
  uint32_t header_version;           /* set by nook_bake_irradiance_desc_init */
  const void* next;                  /* NULL */
  const nook_bake_lit_mesh* meshes;  /* NULL only with mesh_count 0: everything is open */
  const float* positions;            /* receivers, 3 a point, world space */
  const float* normals;              /* 3 a point, unit length to 1e-3 */
  nook_bake_environment environment; /* default black */
  uint32_t mesh_count;
  uint32_t point_count;
  uint32_t rays;                     /* paths a point; default 64 */
  uint32_t threads;                  /* default 0: all cores */
  uint64_t seed;                     /* default 1; the result does not depend on the number of threads */
  uint32_t max_bounces;              /* reflections that count, 0: none; default UINT32_MAX: all of them, unbiased */
  float origin_offset;               /* metres along the normal, of rays that leave a surface, >= 0, default 1e-4 */
} nook_bake_irradiance_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_irradiance_desc_init(nook_bake_irradiance_desc* desc, size_t size,
                                                    uint32_t header_version);

/* Writes 3 floats a point to irradiance: RGB, E(n) = integral of L(w) max(n . w, 0) over the sphere, in the map's units times
 * steradians; a diffuse surface there sends E * base colour / pi. Each path samples the environment by luminance and the
 * hemisphere by cosine, weighed by the balance heuristic; the mean is exact, the noise falls with the root of rays. count
 * must be point_count. Returns when it is done. Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_trace_irradiance(const nook_bake_irradiance_desc* desc, float* irradiance,
                                                uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
