/* With a coordinate texture, a compressed material covers a plane without visible repeats. `nook bake
 * synthesis` makes the coordinate texture; the material need not tile. Each texel of the coordinate texture
 * stores which texel of the material the plane shows there.
 *
 * nook_gl_upload_synthesis uploads a coordinate texture and gives its GLSL. */
#ifndef NOOK_SYNTHESIS_H
#define NOOK_SYNTHESIS_H

#include "../nook_material.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_synthesis_s* nook_synthesis;

/* Loads a coordinate texture from the bytes of a .nook file, which you may free afterwards. The library
 * validates everything, so you can load files that you do not trust. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_synthesis_load(nook_context context, const void* bytes, size_t size,
                                         nook_synthesis* out);

/* Releases your reference and sets *synthesis to NULL.
 * Any thread. */
NOOK_API void nook_synthesis_destroy(nook_synthesis* synthesis);

typedef struct nook_synthesis_info {
  uint32_t struct_size;
  /* Texels along a side of the plane. The plane repeats after this length. */
  uint32_t side;
  /* The size in texels of the material that the coordinates refer to. Use the coordinate texture only with a
   * material of this size; see width and height of nook_material_info. */
  uint32_t material_width;
  uint32_t material_height;
  /* The bytes that the texture takes in host memory. An upload takes the same number of bytes in texture
   * memory. */
  uint64_t texture_bytes;
} nook_synthesis_info;

/* Describes a coordinate texture.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_synthesis_describe(nook_synthesis synthesis, nook_synthesis_info* info);

/* Gives the material's texture coordinates at points of the plane, for nook_material_pixel. In plane_uvs,
 * pass the texture coordinates that you would use to tile the material. plane_uvs and material_uvs are in
 * tiles of the material. Compute dx and dy of nook_material_pixel from the plane's coordinates. Any thread.
 * Errors: INVALID_ARGUMENT (also if a coordinate of the plane is not finite). */
NOOK_API nook_result nook_synthesis_material_uvs(nook_synthesis synthesis, const float* plane_uvs,
                                                 uint32_t count, float* material_uvs);

/* ---- In shaders ----
 *
 *
 * Call nook_gl_upload_synthesis once. Put its GLSL after the #version line of your fragment shader, together
 * with the material's GLSL. For each draw, call nook_gl_upload_bind for both uploads. Compute the material's
 * coordinates from the plane's coordinates. Take the derivatives from the plane's coordinates, because the
 * material's coordinates jump and would give wrong mipmap levels:
 *     vec2 at = nook_synthesis_material_uv(uv);
 *     nook_material_decode(at, dFdx(uv), dFdy(uv), view, modes);
 *     alpha = nook_material_visibility(nook_material_occlusion(at, dFdx(uv), dFdy(uv), view));
 * The coordinate texture costs one additional texture fetch per pixel. */

/* Uploads a coordinate texture, which you may destroy afterwards. The upload consists of a
 * GL_TEXTURE_2D_ARRAY of GL_RG16UI for the sampler nook_synthesis_texels, and GLSL with the function
 *     vec2 nook_synthesis_material_uv(vec2 uv);
 * The GLSL depends only on the sizes of the plane and of the material. On failure *out is NULL and no OpenGL
 * object is left. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the plane is larger than a texture
 * of this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_synthesis(nook_gl gl, nook_synthesis synthesis, nook_gl_upload* out);

#ifdef __cplusplus
}
#endif
#endif
