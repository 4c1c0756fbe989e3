/* The bakers as a library, nook_bake: import of characters from glTF or from memory, poses, bakes of
 * characters, materials and radiance transfer as jobs, and ray-traced references.
 *
 * nook_bake is for offline use. It links Embree, oneTBB and other libraries, and the runtime library, nook,
 * never needs it. Its results are the bytes of .nook files, which nook_character_model_load,
 * nook_material_load and nook_transfer_load take.
 *
 * Matrices of poses are those of nook_scene_set_pose: one 3x4 matrix for each bone, row-major, from rest
 * space to world space in metres. Vertices are in the imported file's order, the primitives one after
 * another, which is also the order of the runtime's AO. Thread contracts, descriptors and results follow the
 * rules of nook.h; the messages of this library are in nook_bake_last_message(). */
#ifndef NOOK_BAKE_H
#define NOOK_BAKE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_bake_character_s* nook_bake_character;
typedef struct nook_bake_job_s* nook_bake_job;

/* Returns the message of this thread's latest failure in this library, as nook_last_message() does for the
 * runtime.
 * Any thread. */
NOOK_API const char* nook_bake_last_message(void);

/* Returns the version of this library, which compares with NOOK_VERSION.
 * Any thread. */
NOOK_API uint32_t nook_bake_version(void);

/* ---- Characters: immutable; jobs that use one keep it alive ---- */

/* Imports a rigged character from a .glb or .gltf file. path is UTF-8. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE (the message names the file and the fault),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_import_gltf(const char* path, nook_bake_character* out);

/* Imports a rigged character from the bytes of a .glb or .gltf file; the caller may free the bytes
 * afterwards. The call reads no other file, so that all buffers must be embedded. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_import_gltf_bytes(const void* bytes, size_t size, nook_bake_character* out);

/* A range of vertices that belong together, such as those of one draw call. */
typedef struct nook_bake_primitive {
  uint32_t first_vertex;
  uint32_t vertex_count;
} nook_bake_primitive;

/* A character in memory, in its rest pose and in metres. nook_bake_character_create copies all arrays. */
typedef struct nook_bake_mesh_desc {
  /* nook_bake_mesh_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Metres, 3 floats for each vertex. */
  const float* positions;
  /* 3 vertex indices for each triangle. */
  const uint32_t* indices;
  /* `influences` bone indices for each vertex. */
  const uint16_t* joints;
  /* `influences` weights >= 0 for each vertex; the import normalises them. */
  const float* weights;
  uint32_t vertex_count;
  /* A multiple of 3. */
  uint32_t index_count;
  /* Default 4. The import keeps the 8 largest weights of each vertex. */
  uint32_t influences;
  uint32_t bone_count;
  /* NULL: the names are bone_0, bone_1 and so on. */
  const char* const* bone_names;
  /* The index of each bone's parent, which is smaller than the bone's own index; -1 for a root. */
  const int32_t* bone_parents;
  /* Joint frames in rest space, 12 floats for each bone: orthonormal axes, with the origin at the joint. */
  const float* bone_frames_3x4;
  /* Primitives in order and without gaps. NULL: one primitive holds all vertices. */
  const nook_bake_primitive* primitives;
  uint32_t primitive_count;
} nook_bake_mesh_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_mesh_desc_init(nook_bake_mesh_desc* desc, size_t size,
                                              uint32_t header_version);

/* Creates a character from arrays. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_create(const nook_bake_mesh_desc* desc, nook_bake_character* out);

/* Releases the caller's reference and sets *character to NULL; *character may be NULL. Jobs that still run
 * keep the character alive.
 * Any thread. */
NOOK_API void nook_bake_character_destroy(nook_bake_character* character);

typedef struct nook_bake_character_info {
  /* sizeof(nook_bake_character_info); the caller sets it. */
  uint32_t struct_size;
  /* The number of vertices after welding: vertices that the file splits at seams count once. */
  uint32_t vertex_count;
  /* The number of vertices in the file, over all primitives. */
  uint32_t file_vertex_count;
  /* The number of triangles with an area; the import drops degenerate ones. */
  uint32_t triangle_count;
  uint32_t bone_count;
  uint32_t clip_count;
  uint32_t primitive_count;
  /* The number of things that the import left out or repaired. */
  uint32_t warning_count;
  /* Minimum and maximum of the rest pose, metres. */
  float bounds_min[3];
  float bounds_max[3];
} nook_bake_character_info;

/* Describes a character.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_describe(nook_bake_character character,
                                                  nook_bake_character_info* info);

/* Returns the name of a bone, or NULL for an index out of range. The text is valid while the character lives.
 * Any thread. */
NOOK_API const char* nook_bake_character_bone_name(nook_bake_character character, uint32_t bone);

/* Returns the name of a clip, or NULL for an index out of range. The text is valid while the character lives.
 * Any thread. */
NOOK_API const char* nook_bake_character_clip_name(nook_bake_character character, uint32_t clip);

/* Returns the name of a primitive, or NULL for an index out of range. The text is valid while the character
 * lives.
 * Any thread. */
NOOK_API const char* nook_bake_character_primitive_name(nook_bake_character character, uint32_t primitive);

/* Returns the text of a warning of the import, or NULL for an index out of range. The text is valid while the
 * character lives.
 * Any thread. */
NOOK_API const char* nook_bake_character_warning(nook_bake_character character, uint32_t warning);

/* Writes the parents (-1 for a root) and the rest frames (12 floats each) of all bones; either array may be
 * NULL. bone_count must be the character's.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_bones(nook_bake_character character, int32_t* parents,
                                                    float* frames_3x4, uint32_t bone_count);

/* Gives the vertex range of a primitive.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_describe_primitive(nook_bake_character character, uint32_t primitive,
                                                            nook_bake_primitive* out);

/* Gives the length of a clip in seconds.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_clip_duration(nook_bake_character character, uint32_t clip,
                                                       float* seconds);

/* Writes the pose of a clip at time_s, which is in seconds from the first key and is clamped to the clip's
 * length. bone_count must be the character's.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_sample_clip(nook_bake_character character, uint32_t clip,
                                                     float time_s, float* bones_3x4, uint32_t bone_count);

/* Writes pose_count generated whole-body poses, one after another; bones_3x4 holds pose_count * bone_count
 * matrices. The same seed gives the same poses.
 * Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_auto_poses(nook_bake_character character, uint64_t seed,
                                                    uint32_t pose_count, float* bones_3x4,
                                                    uint32_t bone_count);

/* Writes poses in which one joint is rotated: every joint that moves some but not all vertices, on a grid of
 * steps^3 rotations over +-range_degrees about its axes. With bones_3x4 NULL the call only sets *pose_count
 * to the number of poses; otherwise *pose_count must be that number before the call.
 * Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_single_joint_poses(nook_bake_character character, uint32_t steps,
                                                            float range_degrees, uint32_t* pose_count,
                                                            float* bones_3x4, uint32_t bone_count);

/* Writes rest positions (metres) and unit normals, 3 floats for each vertex in file order; either array may
 * be NULL. Normals are area-weighted over the welded surface. vertex_count must be file_vertex_count.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_vertices(nook_bake_character character, float* positions,
                                                       float* normals, uint32_t vertex_count);

/* Writes triangles as indices of vertices in file order. Where the file splits vertices at a seam, all
 * triangles around it use the first of them, which is right for AO and positions but not for texture
 * coordinates. index_count must be 3 * triangle_count.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_triangles(nook_bake_character character, uint32_t* indices,
                                                        uint32_t index_count);

/* Writes the four bones with the largest weights of each vertex in file order, in descending order, and their
 * weights, whose sum is 1. vertex_count must be file_vertex_count.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_bake_character_read_skin(nook_bake_character character, uint16_t* joints,
                                                   float* weights, uint32_t vertex_count);

/* Writes the world-space positions (metres) and area-weighted unit normals of a pose, 3 floats for each
 * vertex in file order; either array may be NULL. The call uses linear blend skinning with all weights.
 * Any thread. Errors: INVALID_ARGUMENT (a count is wrong, or a matrix is not finite). */
NOOK_API nook_result nook_bake_character_skin(nook_bake_character character, const float* bones_3x4,
                                              uint32_t bone_count, float* positions, float* normals,
                                              uint32_t vertex_count);

/* ---- Jobs: bakes on threads of their own; any number may run at once ---- */

/* Presets of the effort of a bake; the times are those of two cores. */
enum {
  /* About 20 s. */
  NOOK_BAKE_PRESET_DRAFT = 0,
  /* Up to 5 minutes and 2 GB of memory. */
  NOOK_BAKE_PRESET_STANDARD = 1,
  /* About half an hour. */
  NOOK_BAKE_PRESET_PRODUCTION = 2
};
typedef int32_t nook_bake_preset;

/* The poses that a model is fitted to. */
enum {
  /* Generated whole-body poses, which need no clip. */
  NOOK_BAKE_POSES_AUTO = 0,
  /* One joint at a time, on a grid over +-45 degrees. */
  NOOK_BAKE_POSES_SINGLE_JOINT = 1,
  /* The character's clips. */
  NOOK_BAKE_POSES_CLIPS = 2,
  /* AUTO and CLIPS. */
  NOOK_BAKE_POSES_ALL = 3,
  /* Only extra_poses_3x4. */
  NOOK_BAKE_POSES_EXTRA = 4
};
typedef int32_t nook_bake_pose_mode;

/* The clips that a model is fitted to, when the descriptor names none. */
enum {
  /* Every clip with motion; clips whose name says T-pose or A-pose have none. */
  NOOK_BAKE_SPLIT_ALL = 0,
  /* Every second of these clips in byte order of their names, from the first on, so that the others can
   * measure. */
  NOOK_BAKE_SPLIT_HALF = 1,
  /* Every second family of these clips. A family is the clips whose names start with the same word, in upper
   * or lower case. A word ends at a digit, at a sign and before a capital; the part of a name up to its last
   * | or : does not count, and neither does a prefix of all names that ends at a sign or a digit. A file
   * whose clips are a single family is refused. */
  NOOK_BAKE_SPLIT_FAMILIES = 2
};
typedef int32_t nook_bake_clip_split;

/* The shadow of a sphere at a key point. */
enum {
  /* A smooth horizon, and a fall-off with the exact power of distance. */
  NOOK_BAKE_KERNEL_NOOK = 0,
  /* Le et al. 2019, slide 18. */
  NOOK_BAKE_KERNEL_PAPER = 1,
  /* The horizon of Le et al. 2019, and a fall-off with the exact power of distance. */
  NOOK_BAKE_KERNEL_RATIONAL = 2
};
typedef int32_t nook_bake_kernel;

/* The optimiser of the fit. */
enum {
  /* Mini-batches over both layers at once. */
  NOOK_BAKE_FIT_NOOK = 0,
  /* Block coordinate descent with L-BFGS, as in Le et al. 2019. */
  NOOK_BAKE_FIT_PAPER = 1
};
typedef int32_t nook_bake_fit;

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
  NOOK_BAKE_STAGE_VIEW_MAP = 8
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

/* A gamma that makes the bake try several exponents in short fits and keep the one with the lowest error on
 * held-out poses. The runtime has fast paths for 1, 1.5 and 2; other exponents take two to four times as
 * long. */
#define NOOK_BAKE_GAMMA_LEARNED (-1.0f)

typedef struct nook_bake_job_desc {
  /* nook_bake_job_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Default STANDARD. It gives the numbers that are 0 below, from spheres to samples_per_clip. */
  nook_bake_preset preset;
  /* The maximum number of proxy spheres, up to 1024. */
  uint32_t spheres;
  /* The maximum number of key points, up to 4096. */
  uint32_t key_points;
  /* Rays for each vertex and pose of the ray-traced targets, up to 65,536. */
  uint32_t rays;
  /* Steps of the fit, up to 10,000,000. */
  uint32_t steps;
  /* Default ALL, which is AUTO for a character without clips. */
  nook_bake_pose_mode pose_mode;
  /* The number of generated poses of AUTO and ALL. */
  uint32_t auto_pose_count;
  /* The number of poses of each clip. */
  uint32_t samples_per_clip;
  /* The number of names in clip_names. 0: clip_split chooses the clips. */
  uint32_t clip_count;
  /* The names of the clips to use. An unknown name fails, and the message lists the clips of the
   * character. */
  const char* const* clip_names;
  /* Default ALL. */
  nook_bake_clip_split clip_split;
  /* The number of poses in extra_poses_3x4. */
  uint32_t extra_pose_count;
  /* Poses in addition to those of pose_mode, bone_count matrices each. The call copies them. */
  const float* extra_poses_3x4;
  /* Default 1. The same seed gives the same bytes on any number of threads. */
  uint64_t seed;
  /* Default 0: all cores; up to 1024. */
  uint32_t threads;
  /* Default NOOK. */
  nook_bake_kernel kernel;
  /* Default NOOK. */
  nook_bake_fit fit;
  /* The exponent of the shadow norm, 1 to 8, or NOOK_BAKE_GAMMA_LEARNED. 0 (default) means 1. */
  float gamma;
  /* Seconds after which the fit ends. Default 0: no limit. A fit that the limit ends is not reproducible bit
   * for bit. */
  double time_limit_s;
  /* NULL (default): the host polls instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_job_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_job_desc_init(nook_bake_job_desc* desc, size_t size, uint32_t header_version);

/* Checks the descriptor, starts to bake and returns at once. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_job_start(nook_bake_character character, const nook_bake_job_desc* desc,
                                         nook_bake_job* out);

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

/* ---- Materials: jobs as above, from a built-in meso-structure or from measured data ---- */

/* The compression of a material (Tsai and Shih, TOG 2012). */
enum {
  /* K-clustered tensor approximation. */
  NOOK_BAKE_METHOD_K_CTA = 0,
  /* Clustered tensor approximation: each view has one cluster. */
  NOOK_BAKE_METHOD_CTA = 1,
  /* N-mode singular value decomposition: one cluster. */
  NOOK_BAKE_METHOD_N_SVD = 2
};
typedef int32_t nook_bake_method;

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

/* ---- Radiance transfer: jobs as above, from a static textured shape in memory ---- */

/* A shape in the space of its vertices, which light is later turned into, in metres.
 * nook_bake_transfer_start copies all arrays. docs/transfer.md describes what is baked. */
typedef struct nook_bake_transfer_desc {
  /* nook_bake_transfer_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* 3 floats for each vertex. */
  const float* positions;
  /* 3 floats for each vertex, of unit length to 1e-3. */
  const float* normals;
  /* 4 floats for each vertex: a unit vector along growing u, and a handedness of 1 or -1, so that handedness
   * * cross(normal, tangent) points along growing v. In glTF, TANGENT has this vector and the opposite
   * handedness. NULL: the job makes tangents from the texture coordinates by the rule of MikkTSpace. */
  const float* tangents;
  /* 2 floats for each vertex, the material's texture coordinates. */
  const float* uvs;
  /* 3 vertex indices for each triangle; both sides occlude. */
  const uint32_t* indices;
  /* Up to 10,000,000. */
  uint32_t vertex_count;
  /* A multiple of 3. */
  uint32_t index_count;
  /* The number of lobes that will hold the light, 12 to 2562; default 642. The file has a byte for each lobe
   * and vertex. */
  uint32_t lobes;
  /* Cells along a face of the cube of ray directions, 8 to 256; default 32, which is 6,144 rays for each
   * vertex. */
  uint32_t ray_side;
  /* Default 0: all cores; up to 1024. The bytes do not depend on it. */
  uint32_t threads;
  /* Must be 0. */
  uint32_t reserved;
  /* NULL (default): the host polls instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_transfer_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_transfer_desc_init(nook_bake_transfer_desc* desc, size_t size,
                                                  uint32_t header_version);

/* Checks the descriptor, copies its arrays, starts to bake and returns at once. nook_bake_job_model gives the
 * bytes for nook_transfer_load. The report holds the settings, sizes, the time and warnings. On failure *out
 * is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_transfer_start(const nook_bake_transfer_desc* desc, nook_bake_job* out);

/* ---- Ray-traced ambient occlusion of a scene ---- */

/* A mesh in world space and metres. */
typedef struct nook_bake_occluder_mesh {
  /* 3 floats for each vertex. */
  const float* positions;
  /* 3 vertex indices for each triangle; both sides occlude. */
  const uint32_t* indices;
  uint32_t vertex_count;
  uint32_t index_count;
} nook_bake_occluder_mesh;

typedef struct nook_bake_trace_desc {
  /* nook_bake_trace_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* NULL only if mesh_count is 0; then everything is open. */
  const nook_bake_occluder_mesh* meshes;
  /* The receivers: world space, metres, 3 floats for each point. */
  const float* positions;
  /* 3 floats for each point, of unit length to 1e-3. */
  const float* normals;
  uint32_t mesh_count;
  uint32_t point_count;
  /* Cosine-weighted rays for each point, up to 65,536; default 64. */
  uint32_t rays;
  /* Default 0: all cores; up to 1024. */
  uint32_t threads;
  /* Default 1. The result does not depend on the number of threads. */
  uint64_t seed;
  /* Metres, > 0, default infinity: hits beyond this distance count as open. */
  float radius;
  /* Metres along the normal, >= 0, default 1e-4: the distance of a ray's origin from its point. */
  float origin_offset;
} nook_bake_trace_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_trace_desc_init(nook_bake_trace_desc* desc, size_t size,
                                               uint32_t header_version);

/* Traces the cosine-weighted visibility of all points and writes point_count values to ao; count must be
 * point_count. The call returns when all points are done.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_trace_ao(const nook_bake_trace_desc* desc, float* ao, uint32_t count);

/* ---- Path-traced irradiance of a scene under an environment ---- */

/* A latitude-longitude map of linear radiance, which is constant over a texel. Rows go from +y to -y, and
 * columns around y: the middle column looks along +x, and the column a quarter of the width to its right
 * along +z. */
typedef struct nook_bake_environment {
  /* 3 floats in [0, 1e15] for each texel, rows from the top. NULL only if width is 0; then the environment is
   * black. */
  const float* rgb;
  /* Texels, up to 16384. */
  uint32_t width;
  /* Texels, up to 8192. */
  uint32_t height;
} nook_bake_environment;

/* A mesh in world space and metres with a diffuse surface, which is the same from both sides. */
typedef struct nook_bake_lit_mesh {
  /* 3 floats for each vertex. */
  const float* positions;
  /* 3 vertex indices for each triangle. */
  const uint32_t* indices;
  uint32_t vertex_count;
  uint32_t index_count;
  /* RGB, the share of light that the surface reflects, in [0, 1]. A surface with 0 only occludes. */
  float base_colour[3];
  /* RGB, the radiance that the surface emits, in [0, 1e15]. */
  float emission[3];
} nook_bake_lit_mesh;

typedef struct nook_bake_irradiance_desc {
  /* nook_bake_irradiance_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* NULL only if mesh_count is 0; then everything is open. */
  const nook_bake_lit_mesh* meshes;
  /* The receivers: world space, metres, 3 floats for each point. */
  const float* positions;
  /* 3 floats for each point, of unit length to 1e-3. */
  const float* normals;
  /* Default black. */
  nook_bake_environment environment;
  uint32_t mesh_count;
  uint32_t point_count;
  /* Paths for each point, up to 65,536; default 64. */
  uint32_t rays;
  /* Default 0: all cores; up to 1024. */
  uint32_t threads;
  /* Default 1. The result does not depend on the number of threads. */
  uint64_t seed;
  /* The maximum number of reflections; 0 traces direct light only. Default UINT32_MAX: all of them, without
   * bias. */
  uint32_t max_bounces;
  /* Metres along the normal, >= 0, default 1e-4: the distance of a ray's origin from the surface that it
   * leaves. */
  float origin_offset;
} nook_bake_irradiance_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_irradiance_desc_init(nook_bake_irradiance_desc* desc, size_t size,
                                                    uint32_t header_version);

/* Traces the irradiance of all points and writes 3 floats (RGB) for each to irradiance; count must be
 * point_count. E(n) = integral of L(w) max(dot(n, w), 0) over the sphere, in the map's unit times steradians;
 * a diffuse surface there reflects the radiance E * base colour / pi. Each path samples the environment by
 * luminance and the hemisphere by cosine, combined by the balance heuristic. The estimate is unbiased, and
 * its noise falls with the square root of rays. The call returns when all points are done.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_trace_irradiance(const nook_bake_irradiance_desc* desc, float* irradiance,
                                                uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
