/* Planes that wear a compressed material without visible repeats: coordinate textures, which `nook bake
 * synthesis` makes from a material that tiles or does not. A texel of the plane names the texel of the
 * material that is shown there.
 *
 * nook_gl_synthesis.h uploads a coordinate texture and has its GLSL. */
#ifndef NOOK_SYNTHESIS_H
#define NOOK_SYNTHESIS_H

#include "nook_material.h"

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
  /* sizeof(nook_synthesis_info); the caller sets it. */
  uint32_t struct_size;
  /* Texels along a side of the plane, which repeats after them. */
  uint32_t side;
  /* Texels of the material. */
  uint32_t material_width;
  uint32_t material_height;
  /* The size of the texture in host memory, and after an upload in texture memory. */
  uint64_t texture_bytes;
} nook_synthesis_info;

/* Describes a coordinate texture.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_synthesis_describe(nook_synthesis synthesis, nook_synthesis_info* info);

/* Compares the coordinate texture with a material that it is to be used with: the texels must be as many.
 * Any thread. Errors: INVALID_ARGUMENT (the sizes differ; the message has both). */
NOOK_API nook_result nook_synthesis_check_material(nook_synthesis synthesis, nook_material material);

/* Gives the material's texture coordinates at points of the plane, for nook_material_sample. Both are in
 * tiles of the material: the plane's coordinates are those that would tile it. The mipmap level is that of
 * the plane's coordinates. Any thread. Errors: INVALID_ARGUMENT (also, a coordinate of the plane is not
 * finite). */
NOOK_API nook_result nook_synthesis_material_uvs(nook_synthesis synthesis, const float* plane_uvs,
                                                 uint32_t count, float* material_uvs);

#ifdef __cplusplus
}
#endif
#endif
