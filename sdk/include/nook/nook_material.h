/* Compressed materials: bidirectional texture functions (BTF) and view-dependent occlusion texture functions
 * (VOTF). `nook bake material` bakes them. Your shaders (nook_gl.h) or the CPU decode them per pixel. The
 * method is Y.-T. Tsai and Z.-C. Shih, K-Clustered Tensor Approximation, TOG 2012. Its equation (24) computes
 * the BTF from cores, bases, memberships and coefficients. Each view mixes K of the C clusters. N-SVD is the
 * case C = K = 1, and CTA is the case K = 1. Equation (25) computes the VOTF, which has no light mode.
 * Loading expands the x and y modes into images S_c[a, b]. A pixel then computes
 *     light mode a:  L_a = sum_k sum_b coefficient[view, k, b] S_c(k)[a, b](u, v)
 *     radiance:      sum_a light_basis[light, a] L_a, for red, green and blue, and again for each light.
 * L_a and radiance are linear in the images, so mipmaps give the exact mean over a pixel's footprint. A
 * neural material (`--method neural`) replaces the BTF's tensor by a small network over features of its
 * texels. You load, evaluate and draw it with the same calls. Radiance transfer does not accept it, because
 * its radiance is not a sum of light modes. Its mipmaps average features, not radiance. Directions are unit
 * vectors in tangent space that point away from the surface: x along u, y along v, z along the normal. */
#ifndef NOOK_MATERIAL_H
#define NOOK_MATERIAL_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The contents of a material's VOTF. */
enum {
  /* There is no VOTF; the surface is visible everywhere. */
  NOOK_MATERIAL_VISIBILITY_NONE = 0,
  /* A mask: 1 where the view ray hits the meso-structure, 0 where the ray passes through. */
  NOOK_MATERIAL_VISIBILITY_MASK = 1,
  /* The signed distance to the boundary of the mask, positive where the view ray hits the meso-structure. */
  NOOK_MATERIAL_VISIBILITY_DISTANCE = 2
};
typedef int32_t nook_material_visibility;

/* How a material's spatial modes are stored, in host memory and in textures. On WebGL 2, each block format
 * needs an extension that your page must enable. */
enum {
  /* The same numbers as in the file: signed bytes, or half floats. Every context supports these textures. */
  NOOK_MATERIAL_BLOCKS_NONE = 0,
  /* Signed RGTC (BC5): blocks of 4 x 4 texels, which take half the bytes. Needs OpenGL, or OpenGL ES with
   * GL_EXT_texture_compression_rgtc. In WebGL, both sides of the tile must be multiples of 4 texels. */
  NOOK_MATERIAL_BLOCKS_RGTC = 1,
  /* Signed EAC (RG11). Needs OpenGL ES, OpenGL 4.3 or GL_ARB_ES3_compatibility. Most desktop drivers store it
   * uncompressed. */
  NOOK_MATERIAL_BLOCKS_EAC = 2
};
typedef int32_t nook_material_blocks;

typedef struct nook_material_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_MATERIAL_BLOCKS_NONE. If you choose blocks, a shader needs two fetches for four values.
   * Modes that are not in blocks, and the light map, become signed bytes, even if the file has half floats.
   * For up to 128 lights, the light map has 32 x 32 cells. The VOTF is in blocks too. In a neural material,
   * only the VOTF is in blocks. */
  nook_material_blocks blocks;
  /* The first whole_light_modes light modes are not stored in blocks, because blocks cause the largest errors
   * in these modes. The number is rounded up to a multiple of 4; 0 to 3,072, default 4. */
  int32_t whole_light_modes;
} nook_material_desc;
static inline nook_result nook_material_desc_init(nook_material_desc* desc) {
  return nook_desc_init(NOOK_DESC_MATERIAL, desc, sizeof *desc, NOOK_VERSION);
}

/* Loads a material from the bytes of a .nook file, which you may free afterwards. If `desc` is NULL, the call
 * uses the defaults. The call expands the material, through the context's parallel_for if you set one. It
 * validates all values, so you can load files that you do not trust. On failure *out is NULL. With blocks,
 * textures take about half the memory, and nook_material_evaluate computes from the same blocks as the
 * shader. Some drivers (llvmpipe) interpolate RGTC with byte weights, so decoded values can differ by 4/127.
 * If the file has half floats, you cannot use blocks together with radiance transfer that was baked for this
 * file. Any thread. Errors: INVALID_ARGUMENT (also if the blocks of a tensor take more than 1 GiB, which can
 * happen with very small tiles), BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_material_load(nook_context context, const void* bytes, size_t size,
                                        const nook_material_desc* desc, nook_material* out);

/* Releases your reference and sets *material to NULL. Any thread. */
NOOK_API void nook_material_destroy(nook_material* material);

/* One clustered tensor. The symbols are as in the paper. */
typedef struct nook_material_tensor {
  /* R_l is the rank of the light mode (1 for a VOTF). R_v is the rank of the view mode in each cluster. */
  uint32_t rank_light, rank_view;
  /* R_x and R_y, the ranks of the spatial modes. */
  uint32_t rank_x, rank_y;
  /* C and K: the number of clusters, and the number of clusters that a view mixes. */
  uint32_t clusters, mixture;
  /* Cells along the side of the view map. 0: no view map; a decoder mixes the three nearest views. */
  uint32_t view_map_side;
  /* How many clusters a pixel mixes: K with a view map, up to 3 K without (3 for CTA, 1 for N-SVD). */
  uint32_t terms;
} nook_material_tensor;

typedef struct nook_material_info {
  uint32_t struct_size;
  nook_material_visibility visibility;
  /* Threshold and weight of the visibility mapping, equation (26), as baked. */
  float visibility_threshold, visibility_weight;
  /* I_l and I_v: the numbers of sampled light directions and view directions. */
  uint32_t light_count, view_count;
  /* The size of the BTF in texels. */
  uint32_t width, height;
  nook_material_tensor btf;
  /* All fields are 0 without a VOTF. */
  nook_material_tensor votf;
  /* The numbers of texel fetches and scalar multiply-adds of nook_material_decode. A filtered fetch counts as
   * one, and a mode in blocks as two fetches. A relief adds at most one fetch per plane of its ray march. */
  uint32_t decode_fetches, decode_multiply_adds;
  /* The same numbers for nook_material_radiance. */
  uint32_t light_fetches, light_multiply_adds;
  /* The same numbers for nook_material_occlusion. */
  uint32_t occlusion_fetches, occlusion_multiply_adds;
  /* The bytes of cores, bases, memberships and coefficients, as half floats or 8 bits. Files are smaller. */
  uint64_t compressed_bytes;
  /* Bytes of the view maps, which compressed_bytes does not include. */
  uint64_t view_map_bytes;
  /* Bytes of the expanded images, in host memory now, and in texture memory after an upload. */
  uint64_t table_bytes;
  /* For a neural material, where `btf` is all 0: feature channels, and units per layer. Otherwise 0. */
  uint32_t neural_channels, neural_units;
  /* How many fetches each sample beyond the first adds, in the two _anisotropic functions. */
  uint32_t further_decode_fetches, further_occlusion_fetches;
} nook_material_info;

/* Describes a material. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_material_describe(nook_material material, nook_material_info* info);

typedef struct nook_material_value {
  /* Linear RGB towards the view, if the irradiance on a plane that faces the light is 1. Negative radiance,
   * which is a compression error, is clamped to 0, here and in the GLSL. */
  float radiance[3];
  /* The VOTF: a filtered mask in [0, 1], or a distance in [-1, 1]; 1 without a VOTF. */
  float occlusion;
  /* Equation (26): 1 if occlusion >= threshold; weight * occlusion from 0 to the threshold; 0 below 0. */
  float visibility;
} nook_material_value;

/* The largest number of fetches along the longer side of a pixel. */
enum { NOOK_MATERIAL_MAX_FETCHES = 8 };

/* A pixel footprint of any shape. To evaluate exactly one mipmap level, pass 1 fetch and an isotropic
 * footprint with dx[1] = dy[0] = 0:
 *     pixel.dx[0] = exp2f(level) / (float)info.width;  pixel.dy[1] = exp2f(level) / (float)info.height; */
typedef struct nook_material_pixel {
  /* Texture coordinates of the pixel centre; 0 to 1 is one tile, and the tile repeats. */
  float uv[2];
  /* The changes of `uv` to the next pixel to the right and above, dFdx(uv), dFdy(uv). 0: the finest level. */
  float dx[2], dy[2];
  /* Unit vector; a view from below the horizon is moved onto the horizon. */
  float view[3];
  /* Unit vector; light from below the horizon gives black. */
  float light[3];
} nook_material_pixel;

/* Decodes pixels on the CPU, to check your shader. Each value is the mean over `fetches` samples along the
 * longer side of the pixel, 1 to NOOK_MATERIAL_MAX_FETCHES. With 1 fetch and isotropic footprints, compare it
 * with nook_material_decode and nook_material_occlusion; with more fetches, with the _anisotropic functions.
 * The GLSL agrees within 1/255 for radiances up to 1 if the driver filters with float weights (for RGTC see
 * nook_material_load). GPUs filter with about 8-bit weights, which has the effect of a shift by 1/512 of a
 * texel. In seven measured files, for views beyond 60 degrees, two fetches had at most 1/5 of the squared
 * error of one fetch, or 2/5 with neural materials. A footprint that is longer than `fetches` times its width
 * is blurred across its width too. Any thread. Errors: INVALID_ARGUMENT (also if a number of a pixel is not
 * finite, or `fetches` is out of range). */
NOOK_API nook_result nook_material_evaluate(nook_material material, const nook_material_pixel* pixels,
                                            uint32_t count, uint32_t fetches, nook_material_value* values);

#ifdef __cplusplus
}
#endif
#endif
