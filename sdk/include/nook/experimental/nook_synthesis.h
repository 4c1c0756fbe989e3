/* Planes that wear a compressed material without visible repeats: coordinate textures, which `nook bake
 * synthesis` makes from a material that tiles or does not. A texel of the plane names the texel of the
 * material that is shown there.
 *
 * nook_gl_upload_synthesis uploads a coordinate texture and gives its GLSL. */
#ifndef NOOK_SYNTHESIS_H
#define NOOK_SYNTHESIS_H

#include "../nook_material.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_synthesis_s* nook_synthesis;

/* Loads a coordinate texture from the bytes of a .nook file; the caller may free the bytes afterwards. The
 * library validates everything, so that hostile bytes are safe. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_synthesis_load(nook_context context, const void* bytes, size_t size,
                                         nook_synthesis* out);

/* Releases the caller's reference and sets *synthesis to NULL.
 * Any thread. */
NOOK_API void nook_synthesis_destroy(nook_synthesis* synthesis);

typedef struct nook_synthesis_info {
  uint32_t struct_size;
  /* Texels along a side of the plane, which repeats after them. */
  uint32_t side;
  /* Texels of the material that the coordinates are for. Compare them with width and height of
   * nook_material_info: use the coordinate texture only with a material of the same size. */
  uint32_t material_width;
  uint32_t material_height;
  /* The size of the texture in host memory, and after an upload in texture memory. */
  uint64_t texture_bytes;
} nook_synthesis_info;

/* Describes a coordinate texture.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_synthesis_describe(nook_synthesis synthesis, nook_synthesis_info* info);

/* Gives the material's texture coordinates at points of the plane, for nook_material_pixel. Both are in
 * tiles of the material: the plane's coordinates are those that would tile it. Take dx and dy of the pixel
 * from the plane's coordinates. Any thread. Errors: INVALID_ARGUMENT (also, a coordinate of the plane is not
 * finite). */
NOOK_API nook_result nook_synthesis_material_uvs(nook_synthesis synthesis, const float* plane_uvs,
                                                 uint32_t count, float* material_uvs);

/* ---- In shaders ----
 *
 * Coordinate textures in the host's shaders: a material on a plane without visible repeats.
 *
 * Call nook_gl_upload_synthesis once. Put its GLSL after the #version line of your fragment shader, beside
 * the material's. For each draw, call nook_gl_upload_bind for both uploads. Compute the material's
 * coordinates from the plane's. Take the pixel's sides from the plane, so that the mipmap level does not
 * depend on the texture's jumps:
 *     vec2 at = nook_synthesis_material_uv(uv);
 *     nook_material_decode(at, dFdx(uv), dFdy(uv), view, modes);
 *     alpha = nook_material_visibility(nook_material_occlusion(at, dFdx(uv), dFdy(uv), view));
 * A pixel needs one more fetch. */

/* Uploads a coordinate texture, which you may destroy afterwards. The upload has a GL_TEXTURE_2D_ARRAY of
 * GL_RG16UI for the sampler nook_synthesis_texels, and GLSL with the function
 *     vec2 nook_synthesis_material_uv(vec2 uv);
 * Planes and materials of the same sizes have the same GLSL. On failure *out is NULL and no OpenGL object is
 * left. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the plane is larger than a texture of this
 * OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_synthesis(nook_gl gl, nook_synthesis synthesis, nook_gl_upload* out);

#ifdef __cplusplus
}
#endif
#endif
