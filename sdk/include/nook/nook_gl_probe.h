/* Probes in the host's shaders: a probe or a grid as one texture, and the GLSL that evaluates it.
 *
 * An engine loads a probe of lobes and calls nook_gl_probe_create once. It puts the GLSL of
 * nook_gl_probe_describe after the #version line of a fragment or vertex shader, and sets the uniform
 * nook_probe_texels to a texture unit. For each draw it binds the texture to GL_TEXTURE_BUFFER of that unit,
 * on OpenGL ES to GL_TEXTURE_2D.
 * The shader:
 *     NookProbeSurface surface =
 *         NookProbeSurface(normal_ws, view_ws, tangent_ws, vec2(alpha_x, alpha_y), reflectance);
 *     NookProbePlace place = nook_probe_place(position_ws);  // once: the probes around a point
 *     vec3 e = nook_probe_irradiance(place, normal_ws);
 *     colour = nook_probe_ambient(albedo, e, vec3(ao));  // or directional occlusion instead of ao
 *     colour += nook_probe_specular_anisotropic(place, surface) *
 *               nook_probe_specular_occlusion(ao, n_dot_v, roughness);
 * The same functions exist for a single lobe, such as one in a uniform block: nook_probe_lobe_radiance,
 * nook_probe_lobe_irradiance and so on; shaders/probe documents them. NookLobe has the layout of
 * nook_probe_lobe in std140 and std430. The GLSL agrees with nook_probe.h on the CPU within 1e-4 of the
 * largest value. Every name in it begins with nook_ or Nook. */
#ifndef NOOK_GL_PROBE_H
#define NOOK_GL_PROBE_H

#include "nook_gl.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_probe_s* nook_gl_probe;

/* Uploads a probe or a grid of lobes; the caller may destroy the probe afterwards. On failure *out is NULL
 * and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT (also, the basis of the probe is not NOOK_PROBE_GAUSSIANS),
 * UNSUPPORTED (the probe exceeds the texture buffer of this OpenGL: it takes 3 + lobes * (1 + probes) texels,
 * and every OpenGL has 65,536), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_probe_create(nook_gl gl, nook_probe probe, nook_gl_probe* out);

/* Uploads another probe or grid in place of the present one, such as the next preview of a bake; the texture
 * keeps its name. Draws that were issued before still read the old values. On failure the old probe stays.
 * Context thread. Errors: those of nook_gl_probe_create. */
NOOK_API nook_result nook_gl_probe_update(nook_gl_probe gl_probe, nook_probe probe);

/* Deletes the OpenGL objects and sets *gl_probe to NULL; *gl_probe may be NULL. The nook_gl may have been
 * destroyed before, but the OpenGL context of nook_gl_create must be current; after nook_gl_context_lost none
 * is needed.
 * Context thread. */
NOOK_API void nook_gl_probe_destroy(nook_gl_probe* gl_probe);

typedef struct nook_gl_probe_info {
  /* sizeof(nook_gl_probe_info); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of a GL_TEXTURE_BUFFER (OpenGL ES: GL_TEXTURE_2D) that Nook owns: the host binds it, and
   * never changes or deletes it. */
  uint32_t texture;
  /* The size of the texture's buffer; on OpenGL ES of the texture, in rows of 2048 texels. */
  uint64_t bytes;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions: the uniform samplerBuffer (OpenGL ES:
   * sampler2D) nook_probe_texels and the functions above. The text
   * is the same for every probe and valid as long as the library is loaded. */
  const char* glsl;
} nook_gl_probe_info;

/* Describes the texture. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_probe_describe(nook_gl_probe gl_probe, nook_gl_probe_info* info);

#ifdef __cplusplus
}
#endif
#endif
