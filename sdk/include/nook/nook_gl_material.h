/* Materials in the host's shaders: a material as textures, and the GLSL that decodes them per pixel.
 *
 * An engine loads a material and calls nook_gl_material_create once. It puts the GLSL of
 * nook_gl_material_describe after the #version line of a fragment shader, and sets the uniform of each
 * texture to a texture unit. For each draw it binds the textures, with no sampler object on their units. The
 * shader:
 *     vec4 modes[NOOK_LIGHT_VEC4_COUNT];
 *     nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
 *     colour = nook_material_radiance(modes, light) * irradiance;
 *     alpha = nook_material_visibility(nook_material_occlusion(uv, dFdx(uv), dFdy(uv), view));
 * nook_material_radiance is called once for each light, and its result includes the cosine.
 *
 * Both filter a pixel by one fetch of each mode at the mipmap level of its longer side, which blurs grazing
 * views. With several fetches along that side, `fetches` being a constant of 1 to NOOK_MATERIAL_MAX_FETCHES,
 *     nook_material_decode_anisotropic(uv, dFdx(uv), dFdy(uv), view, fetches, modes);
 *     alpha = nook_material_visibility(
 *         nook_material_occlusion_anisotropic(uv, dFdx(uv), dFdy(uv), view, fetches));
 * stay sharp, see nook_material_evaluate_anisotropic. Each fetch beyond the first costs
 * further_decode_fetches of nook_material_info; the modelled cost of a program that calls neither is within
 * 0.2 % of what it is without them.
 *
 * The text of a neural material has the same functions. Its `modes` are no light modes but sums of the
 * network for the pixel: other shaders cannot add them up or mix them.
 *
 * Silhouettes of the meso-structure need two passes over the same triangles. The first pass draws pixels with
 * alpha = 1 and discards the others. The second pass blends those with 0 < alpha < 1 by alpha; it tests depth
 * but does not write it. */
#ifndef NOOK_GL_MATERIAL_H
#define NOOK_GL_MATERIAL_H

#include "nook_gl.h"
#include "nook_material.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_material_s* nook_gl_material;

typedef struct nook_gl_material_desc {
  /* nook_gl_material_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* The maximum number of layers of one texture array; a material with more layers uses several arrays. 0
   * (default): the limit of this OpenGL, which is at least 256. Arrays of blocks have at least 2. */
  int32_t max_layers;
  /* Must be 0. */
  int32_t reserved;
} nook_gl_material_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_gl_material_desc_init(nook_gl_material_desc* desc, size_t size,
                                                uint32_t header_version);

/* Uploads a material, which the caller may destroy afterwards; desc may be NULL for the defaults. On failure
 * *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED (the material needs more texture units or
 * larger textures than this OpenGL has, or blocks that it does not have), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_material_create(nook_gl gl, nook_material material,
                                             const nook_gl_material_desc* desc, nook_gl_material* out);

/* Deletes every OpenGL object of the material and sets *material to NULL; *material may be NULL. The nook_gl
 * may have been destroyed before, but the OpenGL context of nook_gl_create must be current; after
 * nook_gl_context_lost none is needed.
 * Context thread. */
NOOK_API void nook_gl_material_destroy(nook_gl_material* material);

typedef struct nook_gl_material_info {
  /* sizeof(nook_gl_material_info); the caller sets it. */
  uint32_t struct_size;
  /* The number of textures, which is the number of units that a draw binds; the maximum is 16. */
  uint32_t texture_count;
  /* The memory of all textures. */
  uint64_t texture_bytes;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions: constants, uniforms and the functions
   * above. Every name in it begins with nook_, Nook or NOOK_. Materials of the same sizes and mapping have
   * the same text and may share a program; that of a neural material has constants for its weights, and no
   * other material has it. The uniform vec2 nook_visibility_mapping, a constant on OpenGL ES, holds threshold
   * and weight and starts with those of the material; the paper uses 0.5 and 1 for masks, and 0.05 and 12 for
   * distances. The text is valid while the material lives. */
  const char* glsl;
} nook_gl_material_info;

/* Describes the textures of a material. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_material_describe(nook_gl_material material, nook_gl_material_info* info);

typedef struct nook_gl_material_texture {
  /* sizeof(nook_gl_material_texture); the caller sets it. */
  uint32_t struct_size;
  /* GL_TEXTURE_2D_ARRAY. */
  uint32_t target;
  /* The OpenGL name of a texture that Nook owns: the host binds it, and never changes or deletes it. */
  uint32_t texture;
  /* The name of its sampler in the GLSL; it is valid while the material lives. */
  const char* uniform;
} nook_gl_material_texture;

/* Gives one of the texture_count textures. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_material_describe_texture(nook_gl_material material, uint32_t index,
                                                       nook_gl_material_texture* texture);

#ifdef __cplusplus
}
#endif
#endif
