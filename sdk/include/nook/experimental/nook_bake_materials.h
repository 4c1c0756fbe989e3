/* Bakes of texture synthesis and of radiance transfer. These bakes are experimental, like the runtime headers
 * that use their files (experimental/nook_synthesis.h, experimental/nook_transfer.h). Each bake is a job;
 * wait for it with the job functions of nook_bake.h. */
#ifndef NOOK_BAKE_MATERIALS_H
#define NOOK_BAKE_MATERIALS_H

#include "../nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Synthesis ----
 *
 * A synthesis is a texture of coordinates, with which a material covers a plane of any size without visible
 * repeats. The material need not tile. */

/* A material and the settings of its synthesis. docs/synthesis.md describes the method. */
typedef struct nook_bake_synthesis_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The bytes of a .nook file: a material, or a raw material from `nook bake material --keep-raw`. The
   * material must have at least 16 texels along each side. nook_bake_start reads these bytes before it
   * returns. */
  const void* material;
  size_t material_size;
  /* The part of the material that the plane may show: x, y, width and height in texels. If all four are 0
   * (default), the plane may show the whole material. */
  uint32_t crop[4];
  /* 1 (default): the material tiles without a seam, so the plane may continue across the material's border.
   * 0: the material does not tile. If you set `crop`, the bake always treats the material as not tiling. */
  uint32_t is_tiling;
  /* Texels along a side of the plane, a multiple of 64 up to 4096; default 512. The plane repeats after this
   * length. The file has 4 bytes for each texel. */
  uint32_t side;
  /* How far the synthesis shifts coordinates at random, 0 to 1; default 0.8. A larger value gives fewer
   * repeats, but more seams. */
  float jitter;
  /* The number of correction passes at each level, 1 to 16; default 8. */
  uint32_t passes;
  /* The random seed, default 1. The same seed gives the same bytes on any number of threads. */
  uint64_t seed;
  /* The number of threads, up to 1024. The default 0 uses all cores. */
  uint32_t threads;
  uint32_t reserved;
  /* NULL (default): the job calls no function, and you poll it instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
} nook_bake_synthesis_desc;
static inline nook_result nook_bake_synthesis_desc_init(nook_bake_synthesis_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_SYNTHESIS, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts to bake a synthesis, as nook_bake_start does. nook_bake_job_file gives the bytes for
 * nook_synthesis_load. The report of the job contains the sizes, the bake time and measurements of the seams.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), BAD_FILE (`material`),
 * FILE_VERSION, OUT_OF_MEMORY. */
static inline nook_result nook_bake_start_synthesis(const nook_bake_synthesis_desc* desc,
                                                    nook_bake_job* out) {
  return nook_bake_start(desc, out);
}

/* ---- Radiance transfer: from a static textured shape in memory ---- */

/* A shape. Its vertices are in metres, in the shape's own space. At run time, you rotate the light into this
 * space. nook_bake_start copies all arrays. docs/transfer.md describes what is baked. */
typedef struct nook_bake_transfer_desc {
  uint32_t struct_size, type;
  const void* next;
  /* 3 floats for each vertex. */
  const float* positions;
  /* 3 floats for each vertex, of unit length to 1e-3. */
  const float* normals;
  /* 4 floats for each vertex: a unit vector in the direction of increasing u, and a handedness of 1 or -1, so
   * that handedness * cross(normal, tangent) points in the direction of increasing v. The TANGENT of glTF has
   * the same vector and the opposite handedness. If NULL, the job computes tangents from the texture
   * coordinates, as MikkTSpace does. */
  const float* tangents;
  /* 2 floats for each vertex, the material's texture coordinates. */
  const float* uvs;
  /* 3 vertex indices for each triangle; both sides occlude. */
  const uint32_t* indices;
  /* Up to 10,000,000. */
  uint32_t vertex_count;
  /* A multiple of 3. */
  uint32_t index_count;
  /* The number of lobes that represent the light, 12 to 2562; default 642. The file has one byte for each
   * lobe and vertex. */
  uint32_t lobes;
  /* Ray directions are the cells of a cube map. This is the number of cells along a side of a face, 8 to 256;
   * default 32, which gives 6,144 rays per vertex. */
  uint32_t ray_side;
  /* The number of threads, up to 1024. The default 0 uses all cores. The file does not depend on the number
   * of threads. */
  uint32_t threads;
  uint32_t reserved;
  /* NULL (default): the job calls no function, and you poll it instead. */
  nook_bake_progress_fn progress;
  void* progress_user;
  /* The number of light bounces between parts of the shape, 0 (default) to 2. Each bounce adds 18 bytes per
   * vertex. */
  uint32_t bounces;
  /* One unit of texture coordinates contains this many tiles of the material, 0.01 to 1000; default 1. Only
   * `votf` uses it. */
  float tiles;
  /* The bytes of a .nook file with the shape's material. The material must have a VOTF. Light passes through
   * the holes of the VOTF. NULL (default): surfaces have no holes. */
  const void* votf;
  size_t votf_size;
  /* Required for NOOK_FORM_PAPER, otherwise NULL (default): the bytes of a material's .nook file. The result
   * works only with the light modes of this material. */
  const void* material;
  size_t material_size;
  /* For NOOK_FORM_PAPER: the number of vertex clusters, up to 256; 0 (default): one per 360 vertices. */
  uint32_t clusters;
  /* Default NOOK_FORM_DEFAULT: the transfer does not depend on a material, so you can use any material with
   * the shape. NOOK_FORM_PAPER follows Tsai and Shih 2012, for the light modes of `material`. */
  nook_form form;
} nook_bake_transfer_desc;
static inline nook_result nook_bake_transfer_desc_init(nook_bake_transfer_desc* desc) {
  return nook_bake_desc_init(NOOK_DESC_BAKE_TRANSFER, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts to bake radiance transfer, as nook_bake_start does. nook_bake_job_file gives the bytes for
 * nook_transfer_load. The report of the job contains the settings, the sizes, the bake time and warnings.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the first fault), BAD_FILE (`votf` or `material`),
 * OUT_OF_MEMORY. */
static inline nook_result nook_bake_start_transfer(const nook_bake_transfer_desc* desc, nook_bake_job* out) {
  return nook_bake_start(desc, out);
}

#ifdef __cplusplus
}
#endif
#endif
