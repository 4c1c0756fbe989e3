/* Coordinate textures in the host's shaders: a material on a plane without visible repeats.
 *
 * An engine calls nook_gl_synthesis_create once. It puts the GLSL of nook_gl_synthesis_describe after the
 * #version line of a fragment shader, beside the material's, and sets the uniform nook_synthesis_texels to a
 * texture unit. For each draw it binds the texture to GL_TEXTURE_2D_ARRAY of that unit, with no sampler
 * object. The shader takes the material's coordinates from those of the plane, and the sides of a pixel from
 * the plane's, so that its mipmap level does not depend on the jumps of the texture:
 *     vec2 at = nook_synthesis_material_uv(uv);
 *     nook_material_decode(at, dFdx(uv), dFdy(uv), view, modes);
 *     alpha = nook_material_visibility(nook_material_occlusion(at, dFdx(uv), dFdy(uv), view));
 * A pixel needs one more fetch. */
#ifndef NOOK_GL_SYNTHESIS_H
#define NOOK_GL_SYNTHESIS_H

#include "nook_gl_material.h"
#include "nook_synthesis.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_synthesis_s* nook_gl_synthesis;

/* Uploads a coordinate texture, which the caller may destroy afterwards. On failure *out is NULL and no
 * OpenGL object is left. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the plane is larger than a
 * texture of this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_synthesis_create(nook_gl gl, nook_synthesis synthesis, nook_gl_synthesis* out);

/* Deletes the OpenGL objects and sets *synthesis to NULL; *synthesis may be NULL. The nook_gl may have been
 * destroyed before, but the OpenGL context of nook_gl_create must be current; after nook_gl_context_lost none
 * is needed. Context thread. */
NOOK_API void nook_gl_synthesis_destroy(nook_gl_synthesis* synthesis);

typedef struct nook_gl_synthesis_info {
  /* sizeof(nook_gl_synthesis_info); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of a GL_TEXTURE_2D_ARRAY of GL_RG16UI that Nook owns: the host binds it, and never
   * changes or deletes it. */
  uint32_t texture;
  /* The memory of the texture. */
  uint64_t texture_bytes;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions: the uniform usampler2DArray
   * nook_synthesis_texels and the function vec2 nook_synthesis_material_uv(vec2 uv). Every name in it begins
   * with nook_ or NOOK_. Textures of planes and materials of the same sizes have the same text. The text is
   * valid while the object lives. */
  const char* glsl;
} nook_gl_synthesis_info;

/* Describes the texture. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_synthesis_describe(nook_gl_synthesis synthesis, nook_gl_synthesis_info* info);

#ifdef __cplusplus
}
#endif
#endif
