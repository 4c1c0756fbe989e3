/* Bakes of radiance transfer as jobs, which nook_bake.h follows and ends, from a static textured shape in
 * memory. */
#ifndef NOOK_BAKE_TRANSFER_H
#define NOOK_BAKE_TRANSFER_H

#include "nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

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
  /* Reflections of the shape onto itself, 0 (default) to 2; each adds 18 bytes for a vertex. */
  uint32_t bounces;
  /* Tiles of the material in one unit of texture coordinates, 0.01 to 1000, for `votf`; default 1. */
  float tiles;
  /* The bytes of the .nook file of the material that the shape wears: light falls through the holes of its
   * VOTF, which it must have. NULL (default): surfaces have no holes. */
  const void* votf;
  size_t votf_size;
  /* The bytes of the .nook file of a material, for whose light modes the job bakes the paper's form. NULL
   * (default): the separated form, which takes any material. */
  const void* material;
  size_t material_size;
  /* Clusters of vertices of the paper's form, up to 256; 0 (default): one for each 360 vertices. */
  uint32_t clusters;
  /* Must be 0. */
  uint32_t reserved_2;
} nook_bake_transfer_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_bake_transfer_desc_init(nook_bake_transfer_desc* desc, size_t size,
                                                  uint32_t header_version);

/* Checks the descriptor, copies its arrays, starts to bake and returns at once. nook_bake_job_model gives the
 * bytes for nook_transfer_load. The report holds the settings, sizes, the time and warnings. On failure *out
 * is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), VERSION, BAD_FILE (of votf or
 * material), OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_transfer_start(const nook_bake_transfer_desc* desc, nook_bake_job* out);

#ifdef __cplusplus
}
#endif
#endif
