/* Compressed materials: bidirectional texture functions (BTF) and view-dependent occlusion texture functions (VOTF), baked
 * by `nook bake material`, decoded per pixel in the host's shaders, or on the CPU.
 *
 * After Y.-T. Tsai, Z.-C. Shih, K-Clustered Tensor Approximation (2012). With the material's cores, bases, memberships and
 * coefficients, the BTF is equation (24),
 *     B(light, view, x, y) ~ sum_c Z_c x_light U_light x_view U_view,c x_x U_x,c x_y U_y,c,
 * where a view mixes K of the C clusters; N-SVD is C = K = 1, CTA is K = 1. The VOTF is (25), the same without a light
 * mode. Loading expands the x and y modes into images S_c[a, b], so that a pixel needs
 *     light mode a:  L_a = sum_k sum_b coefficient[view, k, b] S_c(k)[a, b](u, v)
 *     radiance:      sum_a light_basis[light, a] L_a, for red, green and blue, and for each light again.
 * All of it is linear in the images: what their mipmaps give is the mean over a pixel's footprint.
 *
 * Directions are in tangent space: x along u, y along v, z along the normal; unit vectors away from the surface.
 *
 * In an engine, once: load, nook_gl_material_create; put the GLSL of nook_gl_material_describe behind the #version line of a
 * fragment shader; set each texture's uniform to the unit that it will be bound to. Each draw: bind the textures, with no
 * sampler object on their units. The shader:
 *     vec4 modes[NOOK_LIGHT_FOURS];
 *     nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
 *     colour = nook_material_radiance(modes, light) * irradiance;      // for every light; the cosine is in it
 *     alpha = nook_material_visibility(nook_material_occlusion(uv, dFdx(uv), dFdy(uv), view));
 * Silhouettes of the meso-structure, in two passes over the same triangles: first pixels with alpha = 1, the others
 * discarded; then those with 0 < alpha < 1, blended by alpha, depth tested but not written. */
#ifndef NOOK_MATERIAL_H
#define NOOK_MATERIAL_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_material_s* nook_material;
typedef struct nook_gl_material_s* nook_gl_material;

enum {
  NOOK_MATERIAL_VISIBILITY_NONE = 0,    /* no VOTF: visible everywhere */
  NOOK_MATERIAL_VISIBILITY_BINARY = 1,  /* a mask: 1 where the view meets the meso-structure, 0 where it passes through */
  NOOK_MATERIAL_VISIBILITY_DISTANCE = 2 /* the distance to that mask's boundary, positive where it is met */
};
typedef int32_t nook_material_visibility;

/* Loads a material from the bytes of a .nook file, which may be freed afterwards, and expands it, on the context's
 * parallel_for where it has one. Everything is validated; safe on hostile bytes. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_material_load(nook_context context, const void* bytes, size_t size, nook_material* out);

/* Releases the caller's hold and sets *material to NULL. Any thread. */
NOOK_API void nook_material_destroy(nook_material* material);

/* One clustered tensor. */
typedef struct nook_material_tensor {
  uint32_t rank_light;    /* R_l; 1 of a VOTF */
  uint32_t rank_view;     /* R_v, of each cluster */
  uint32_t rank_x;        /* R_x */
  uint32_t rank_y;        /* R_y */
  uint32_t clusters;      /* C */
  uint32_t mixture;       /* K */
  uint32_t view_map_side; /* cells of the view map that the file holds; 0: none, the three nearest views are mixed linearly */
  uint32_t terms;         /* clusters that a pixel mixes: K with a view map, up to 3 K without (3 of CTA, 1 of N-SVD) */
} nook_material_tensor;

typedef struct nook_material_info {
  uint32_t struct_size;                /* sizeof(nook_material_info), set by the caller */
  nook_material_visibility visibility;
  float visibility_threshold;          /* of the visibility mapping (26), as it was baked */
  float visibility_weight;
  uint32_t light_count;                /* I_l, sampled directions */
  uint32_t view_count;                 /* I_v */
  uint32_t width, height;              /* texels of the BTF */
  nook_material_tensor btf;
  nook_material_tensor votf;           /* all 0 without a VOTF */
  uint32_t decode_fetches;             /* texels fetched by nook_material_decode, filtered fetches counted once */
  uint32_t decode_multiply_adds;       /* and its multiply-adds on numbers, four to a vector */
  uint32_t light_fetches;              /* of nook_material_radiance */
  uint32_t light_multiply_adds;
  uint32_t occlusion_fetches;          /* of nook_material_occlusion */
  uint32_t occlusion_multiply_adds;
  uint64_t compressed_bytes;           /* cores, bases, memberships and coefficients as half floats and bytes */
  uint64_t view_map_bytes;             /* of the view maps, beside these */
  uint64_t table_bytes;                /* expanded: memory held now, and texture memory once uploaded */
} nook_material_info;
/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_material_describe(nook_material material, nook_material_info* info);

typedef struct nook_material_sample {
  float uv[2];    /* 0 to 1 is one tile; it repeats */
  float level;    /* mipmap level: log2 of the texels that a pixel covers along a side */
  float view[3];  /* unit vector; from below the horizon counts as on it */
  float light[3]; /* unit vector; light from below the horizon gives black */
} nook_material_sample;

typedef struct nook_material_value {
  float radiance[3]; /* linear red, green, blue towards the view, for an irradiance of 1 on a plane that faces the light;
                        compression may leave it slightly negative */
  float occlusion;   /* the VOTF: a filtered mask, or a distance in [-1, 1]; 1 without one */
  float visibility;  /* (26): 1 from the threshold on, weight times occlusion between 0 and it, else 0 */
} nook_material_value;

/* Decodes on the CPU what the GLSL decodes, within 1/255 for radiances up to 1: the reference. Any thread.
 * Errors: INVALID_ARGUMENT (a number of a sample is not finite). */
NOOK_API nook_result nook_material_evaluate(nook_material material, const nook_material_sample* samples, uint32_t count,
                                            nook_material_value* values);

typedef struct nook_gl_material_desc {
  uint32_t struct_size;    /* set by nook_gl_material_desc_init */
  uint32_t header_version; /* set by nook_gl_material_desc_init */
  const void* next;        /* NULL */
  int32_t max_layers;      /* of one texture array; more are split over several. 0 (default): what this OpenGL has, at
                              least 256 */
  int32_t reserved;        /* 0 */
} nook_gl_material_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_gl_material_desc_init(nook_gl_material_desc* desc, size_t size, uint32_t header_version);

/* Uploads a material, which may be destroyed afterwards; desc may be NULL for the defaults. On failure *out is NULL and
 * no OpenGL object is left. Context thread.
 * Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED (more textures than units, or larger ones than this OpenGL has), GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_material_create(nook_gl gl, nook_material material, const nook_gl_material_desc* desc,
                                             nook_gl_material* out);

/* Deletes every OpenGL object of the material and sets *material to NULL; NULL is fine, and so is a nook_gl that was
 * destroyed before. Context thread, with the OpenGL context of nook_gl_create current (any thread after
 * nook_gl_context_lost). */
NOOK_API void nook_gl_material_destroy(nook_gl_material* material);

typedef struct nook_gl_material_info {
  uint32_t struct_size;   /* sizeof(nook_gl_material_info), set by the caller */
  uint32_t texture_count; /* units that a draw binds, at most 16 */
  uint64_t texture_bytes;
  const char* glsl;       /* GLSL 3.30 without #version: constants, uniforms and the functions above. The same text for
                             materials of the same sizes and mapping, which may share a program. Every name begins
                             with nook_ or NOOK_.
                             uniform vec2 nook_visibility_mapping, threshold and weight, begins with the material's
                             own; the paper has 0.5, 1 for masks and 0.05, 12 for distances. Valid while the material
                             lives */
} nook_gl_material_info;
/* Makes no OpenGL call. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_material_describe(nook_gl_material material, nook_gl_material_info* info);

typedef struct nook_gl_material_texture {
  uint32_t struct_size; /* sizeof(nook_gl_material_texture), set by the caller */
  uint32_t target;      /* GL_TEXTURE_2D_ARRAY */
  uint32_t texture;     /* OpenGL name; owned by Nook: bind it, never change or delete it */
  const char* uniform;  /* the name of its sampler in the GLSL; valid while the material lives */
} nook_gl_material_texture;
/* One of the texture_count textures. Makes no OpenGL call. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_material_describe_texture(nook_gl_material material, uint32_t index,
                                                  nook_gl_material_texture* texture);

#ifdef __cplusplus
}
#endif
#endif
