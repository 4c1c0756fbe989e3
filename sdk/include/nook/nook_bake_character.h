/* Characters in the bakers' library: import from glTF or from memory, poses, and bakes as jobs.
 *
 * Matrices of poses are those of nook_scene_set_pose: one 3x4 matrix for each bone, row-major, from rest
 * space to world space in metres. Vertices are in the imported file's order, the primitives one after
 * another, which is also the order of the runtime's AO. */
#ifndef NOOK_BAKE_CHARACTER_H
#define NOOK_BAKE_CHARACTER_H

#include "nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_bake_character_s* nook_bake_character;

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

/* ---- Bakes as jobs: nook_bake.h follows and ends them ---- */

/* Presets of the effort of a bake; the times are those of two cores. */
enum {
  /* About 20 s. */
  NOOK_BAKE_PRESET_DRAFT = 0,
  /* Up to 5 minutes and 2 GB of memory. */
  NOOK_BAKE_PRESET_STANDARD = 1,
  /* Up to half an hour of processor time: nearly four times the poses of STANDARD, twice its rays, and up to
   * 800 key points in place of 500, with which an update takes a fifth longer. */
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
  /* AUTO, CLIPS, and as many variants of the poses of the clips: mirrored, mixed and blended. */
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

/* A gamma that makes the bake try several exponents in short fits and keep the one with the lowest error on
 * held-out poses. The runtime has fast paths for 1, 1.5 and 2; other exponents take two to four times as
 * long. */
#define NOOK_BAKE_GAMMA_LEARNED (-1.0f)

/* A saturation that keeps all shadows unsaturated. */
#define NOOK_BAKE_UNSATURATED (-1.0f)

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
  /* The number of generated poses of AUTO and ALL. The variants of ALL lower its default by their number, at
   * most by half. */
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
  /* The saturation c of each key point before the fit, with which its shadow is n / (1 + c n) of the norm n
   * of its spheres, up to 64; the fit changes it. 0 (default) means 0.5 with fit NOOK and a gamma of 1, and
   * none otherwise. NOOK_BAKE_UNSATURATED: all shadows are their norms. Another number needs fit NOOK and a
   * gamma of 1. */
  float saturation;
} nook_bake_job_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_job_desc_init(nook_bake_job_desc* desc, size_t size, uint32_t header_version);

/* Checks the descriptor, starts to bake and returns at once. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_job_start(nook_bake_character character, const nook_bake_job_desc* desc,
                                         nook_bake_job* out);

#ifdef __cplusplus
}
#endif
#endif
