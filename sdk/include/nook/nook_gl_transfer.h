/* Radiance transfer in the host's shaders: the vectors of a shape's vertices in a texture, and the GLSL that
 * lights a material with them.
 *
 * An engine calls nook_gl_transfer_create once for a shape and nook_gl_transfer_update when the light or the
 * shape turns. It puts the GLSL of nook_gl_transfer_describe after the #version line of the vertex shader,
 * and after the material's GLSL in the fragment shader, and sets the uniform nook_transfer_texels to a
 * texture unit. For each draw it binds the texture to GL_TEXTURE_BUFFER of that unit, on OpenGL ES to
 * GL_TEXTURE_2D. The vertex shader:
 *     out vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];
 *     nook_transfer_vectors(gl_VertexID, vectors);
 * The fragment shader:
 *     vec3 view = nook_transfer_tangent_space(normal, tangent, normalize(eye - position));
 *     vec4 modes[NOOK_LIGHT_VEC4_COUNT];
 *     nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
 *     colour = max(nook_transfer_radiance(modes, vectors), 0.0);
 * 16 light modes are 12 varyings of the 15 that every OpenGL 3.3 has. A material with more uses
 * nook_transfer_mix in the fragment shader instead. A host may also upload the floats of
 * nook_transfer_vectors as vertex attributes of its own; nook_transfer_radiance is the same.
 *
 * A transfer in the paper's form can leave its vertices to the GPU: nook_gl_transfer_create_paper takes them
 * once, and nook_gl_transfer_update_light uploads no vectors but the matrices of the clusters under the
 * light. The host then binds vertex_texture too, to the uniform nook_transfer_vertices, and
 * nook_transfer_vectors in the vertex shader mixes the matrices, on every OpenGL. */
#ifndef NOOK_GL_TRANSFER_H
#define NOOK_GL_TRANSFER_H

#include "nook_gl_material.h"
#include "nook_transfer.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_transfer_s* nook_gl_transfer;

/* Makes room for the vectors of vertex_count vertices under a response, which may be destroyed afterwards.
 * All vectors are 0 at first. On failure *out is NULL and no OpenGL object is left. Context thread. Errors:
 * INVALID_ARGUMENT, UNSUPPORTED (the vectors exceed the texture buffer of this OpenGL: they take vertex_count
 * * vector_floats / 4 texels, and every OpenGL has 65,536), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_transfer_create(nook_gl gl, nook_transfer_response response,
                                             uint32_t vertex_count, nook_gl_transfer* out);

/* Uploads the vectors of all vertices, vertex_count x vector_floats without gaps, as nook_transfer_vectors
 * writes them, of an object of nook_gl_transfer_create. Draws that were issued before still read the old
 * ones. The call does not wait for the GPU. Context thread. Errors: INVALID_ARGUMENT (also, float_count is
 * not vertex_count * vector_floats), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_transfer_update(nook_gl_transfer gl_transfer, const float* vectors,
                                             uint64_t float_count);

/* Makes room for a transfer in the paper's form under a response. The vertices of the transfer are uploaded
 * here, and all light is 0 at first. The object keeps what it needs of both, which may be destroyed
 * afterwards. On failure *out is NULL and no OpenGL object is left. Context thread. Errors: INVALID_ARGUMENT
 * (also, the transfer has the separated form, or light modes or lobes that are not those of the response),
 * UNSUPPORTED (a table exceeds the texture buffer of this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_transfer_create_paper(nook_gl gl, nook_transfer transfer,
                                                   nook_transfer_response response, nook_gl_transfer* out);

/* Uploads the clusters' matrices under the light of lobes, lobe_count x RGB, of an object of
 * nook_gl_transfer_create_paper. The CPU makes them, with the parallel-for of the context. Draws that were
 * issued before still read the old ones. The call does not wait for the GPU. Context thread. Errors:
 * INVALID_ARGUMENT (also, lobe_count is not that of the response), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_transfer_update_light(nook_gl_transfer gl_transfer, const float* amplitudes,
                                                   uint32_t lobe_count);

/* Deletes the OpenGL objects and sets *gl_transfer to NULL; *gl_transfer may be NULL. The nook_gl may have
 * been destroyed before, but the OpenGL context of nook_gl_create must be current; after nook_gl_context_lost
 * none is needed.
 * Context thread. */
NOOK_API void nook_gl_transfer_destroy(nook_gl_transfer* gl_transfer);

typedef struct nook_gl_transfer_info {
  /* sizeof(nook_gl_transfer_info); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of a GL_TEXTURE_BUFFER (OpenGL ES: GL_TEXTURE_2D) that Nook owns: the host binds it, and
   * never changes or deletes it. */
  uint32_t texture;
  /* The size of the textures' buffers; on OpenGL ES of the textures, in rows of 2048 texels. */
  uint64_t bytes;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions: the uniform samplerBuffer (OpenGL ES:
   * sampler2D) nook_transfer_texels and the functions above. Every name in it begins with nook_ or NOOK_. The
   * text is the same for all responses with as many light modes, in the paper's form for all transfers with
   * as many clusters, ranks and reflections too, and is valid while the object lives. */
  const char* glsl;
  /* NOOK_TRANSFER_FORM_PAPER of nook_gl_transfer_create_paper, otherwise NOOK_TRANSFER_FORM_SEPARATED. */
  nook_transfer_form form;
  /* In the paper's form a second texture of the same kind, for nook_transfer_vertices; otherwise 0. */
  uint32_t vertex_texture;
} nook_gl_transfer_info;

/* Describes the texture. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_transfer_describe(nook_gl_transfer gl_transfer, nook_gl_transfer_info* info);

#ifdef __cplusplus
}
#endif
#endif
