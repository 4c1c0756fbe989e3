/* Reference values for measurements: ray-traced ambient occlusion and path-traced irradiance of a scene. The
 * header also declares poses and bake options for comparisons. */
#ifndef NOOK_TRACE_H
#define NOOK_TRACE_H

#include "../nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Studies of characters ---- */

/* Which clips a model is fitted to, if clip_names is empty. */
enum {
  /* Every clip that has motion. Clips named T-pose or A-pose are treated as clips without motion. */
  NOOK_BAKE_SPLIT_ALL = 0,
  /* Every second clip of NOOK_BAKE_SPLIT_ALL, in byte order of the names, starting with the first. You can
   * use the other clips to measure the error. */
  NOOK_BAKE_SPLIT_HALF = 1,
  /* Every second family of the clips of NOOK_BAKE_SPLIT_ALL. A family consists of all clips whose names start
   * with the same word, ignoring case. A word ends at a digit, at a punctuation character or before a capital
   * letter. Two parts of a name are ignored: the part up to its last | or :, and a prefix that all names
   * share and that ends with punctuation or a digit. A file with only one family is refused. */
  NOOK_BAKE_SPLIT_FAMILIES = 2
};
typedef int32_t nook_bake_clip_split;

/* Options that you need only for comparisons. Point nook_bake_character_desc.next to this struct. */
typedef struct nook_bake_character_study_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_BAKE_SPLIT_ALL. */
  nook_bake_clip_split clip_split;
  /* NOOK_FORM_PAPER: the kernel of Le et al. 2019, with any fit. Default NOOK_FORM_DEFAULT: the kernel that
   * belongs to nook_bake_character_desc.form. */
  nook_form kernel;
  /* NOOK_FORM_PAPER: the block coordinate descent of Le et al. 2019, with any kernel. Default
   * NOOK_FORM_DEFAULT: the fit that belongs to nook_bake_character_desc.form. */
  nook_form fit;
  /* The number of recorded poses of your game, in the layout of extra_poses_3x4. At the end, the bake fits
   * two numbers for each vertex to these poses: the constant and the scale of its AO. Default 0: no poses. */
  uint32_t calibration_pose_count;
  const float* calibration_poses_3x4;
} nook_bake_character_study_desc;
static inline nook_result nook_bake_character_study_desc_init(nook_bake_character_study_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_CHARACTER_STUDY, desc, sizeof *desc, NOOK_VERSION);
}

/* Writes poses in which only one joint is rotated. The call rotates every joint that moves some but not all
 * vertices, about its three axes, on a grid of steps^3 rotations over +-range_degrees. With `bones_3x4` NULL,
 * the call only sets *pose_count to the number of poses. Otherwise, you must set *pose_count to this number.
 * Any thread. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_character_single_joint_poses(nook_bake_character character, uint32_t steps,
                                                            float range_degrees, uint32_t* pose_count,
                                                            float* bones_3x4, uint32_t bone_count);

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
  uint32_t struct_size, type;
  const void* next;
  /* May be NULL only if mesh_count is 0. Nothing occludes the points then. */
  const nook_bake_occluder_mesh* meshes;
  /* The receivers: world space, metres, 3 floats for each point. */
  const float* positions;
  /* 3 floats for each point, of unit length to 1e-3. */
  const float* normals;
  uint32_t mesh_count;
  uint32_t point_count;
  /* The number of cosine-weighted rays for each point, up to 65,536; default 64. */
  uint32_t rays;
  /* The number of threads, up to 1024. The default 0 uses all cores. */
  uint32_t threads;
  /* The random seed, default 1. The result does not depend on the number of threads. */
  uint64_t seed;
  /* Metres, > 0, default infinity. A ray that hits nothing within this distance is not occluded. */
  float radius;
  /* The distance of a ray's origin from its point, in metres along the normal; >= 0, default 1e-4. */
  float origin_offset;
  /* NULL (default), or a function that receives the number of traced points during the call. It is called on
   * threads of the trace, one call at a time. If it returns 0, tracing ends within about 10 ms with
   * NOOK_ERROR_CANCELLED. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_trace_desc;
static inline nook_result nook_bake_trace_desc_init(nook_bake_trace_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_TRACE, desc, sizeof *desc, NOOK_VERSION);
}

/* Traces the cosine-weighted visibility of all points and writes point_count values to `ao`. `count` must be
 * point_count. The call returns when all points are done. If it fails, it writes nothing.
 * Any thread. Errors: INVALID_ARGUMENT, CANCELLED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_trace_ao(const nook_bake_trace_desc* desc, float* ao, uint32_t count);

/* ---- Path-traced irradiance of a scene under an environment ---- */

/* A latitude-longitude map of linear radiance, which is constant within a texel. Rows go from +y to -y, and
 * columns go around y. The middle column looks along +x. The column at 3/4 of the width looks along +z. */
typedef struct nook_bake_environment {
  /* 3 floats in [0, 1e15] for each texel, rows from the top. May be NULL only if width is 0. The environment
   * is then black. */
  const float* rgb;
  /* Texels, up to 16384. */
  uint32_t width;
  /* Texels, up to 8192. */
  uint32_t height;
} nook_bake_environment;

/* A mesh in world space and metres with a diffuse surface, which is the same on both sides. */
typedef struct nook_bake_lit_mesh {
  /* 3 floats for each vertex. */
  const float* positions;
  /* 3 vertex indices for each triangle. */
  const uint32_t* indices;
  uint32_t vertex_count;
  uint32_t index_count;
  /* RGB, the share of light that the surface reflects, in [0, 1]. With 0, the surface only occludes. */
  float base_colour[3];
  /* RGB, the radiance that the surface emits, in [0, 1e15]. */
  float emission[3];
} nook_bake_lit_mesh;

typedef struct nook_bake_irradiance_desc {
  uint32_t struct_size, type;
  const void* next;
  /* May be NULL only if mesh_count is 0. Nothing occludes the points then. */
  const nook_bake_lit_mesh* meshes;
  /* The receivers: world space, metres, 3 floats for each point. */
  const float* positions;
  /* 3 floats for each point, of unit length to 1e-3. */
  const float* normals;
  /* Default black. */
  nook_bake_environment environment;
  uint32_t mesh_count;
  uint32_t point_count;
  /* The number of paths for each point, up to 65,536; default 64. */
  uint32_t rays;
  /* The number of threads, up to 1024. The default 0 uses all cores. */
  uint32_t threads;
  /* The random seed, default 1. The result does not depend on the number of threads. */
  uint64_t seed;
  /* The maximum number of reflections; 0 traces direct light only. Default UINT32_MAX: no maximum, so that
   * the result is unbiased. */
  uint32_t max_bounces;
  /* The distance of a ray's origin from the surface that the ray leaves, in metres along the normal; >= 0,
   * default 1e-4. */
  float origin_offset;
  /* As in nook_bake_trace_desc; a block of points with many bounces may take longer than 10 ms. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_irradiance_desc;
static inline nook_result nook_bake_irradiance_desc_init(nook_bake_irradiance_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_IRRADIANCE, desc, sizeof *desc, NOOK_VERSION);
}

/* Traces the irradiance of all points and writes 3 floats (RGB) for each to `irradiance`. `count` must be
 * point_count. E(n) = integral of L(w) max(dot(n, w), 0) over the sphere, in the map's unit times steradians.
 * A diffuse surface with this irradiance reflects the radiance E * base colour / pi. Each path samples the
 * environment by luminance and the hemisphere by cosine, combined by the balance heuristic. The estimate is
 * unbiased, and its noise is proportional to 1 / sqrt(rays). The call returns when all points are done. If it
 * fails, it writes nothing.
 * Any thread. Errors: INVALID_ARGUMENT, CANCELLED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_trace_irradiance(const nook_bake_irradiance_desc* desc, float* irradiance,
                                                uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
