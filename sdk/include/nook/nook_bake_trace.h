/* References for measurements: ray-traced ambient occlusion and path-traced irradiance of a scene. */
#ifndef NOOK_BAKE_TRACE_H
#define NOOK_BAKE_TRACE_H

#include "nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

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
