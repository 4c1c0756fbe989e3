/* Probes in the host's shaders: a probe or a grid as one texture, and the GLSL that evaluates it there.
 *
 * In an engine, once: load a probe of lobes, nook_gl_probe_create; put the GLSL of nook_gl_probe_describe behind the #version
 * line of a fragment or vertex shader; set the uniform nook_probe_texels to the unit that the texture will be bound to. Each
 * draw: bind the texture to GL_TEXTURE_BUFFER of that unit. The shader:
 *     NookProbeSurface surface = NookProbeSurface(normal_ws, view_ws, tangent_ws, vec2(alpha_x, alpha_y), reflectance);
 *     NookProbePlace place = nook_probe_place(position_ws);             // once: the probes round a point
 *     vec3 e = nook_probe_irradiance(place, normal_ws);
 *     colour = nook_probe_ambient(albedo, e, vec3(ao));                 // or a directional occlusion in place of ao
 *     colour += nook_probe_specular_anisotropic(place, surface) * nook_probe_specular_occlusion(ao, n_dot_v, roughness);
 * The same functions for a single lobe, such as one in a uniform block (NookLobe has the layout of nook_probe_lobe in std140 and
 * std430), are nook_probe_lobe_radiance, nook_probe_lobe_irradiance and so on; shaders/probe says which. They agree with
 * nook_probe.h on the CPU within 1e-4 of the largest value. Every name begins with nook_ or Nook. */
#ifndef NOOK_GL_PROBE_H
#define NOOK_GL_PROBE_H

#include "nook_gl.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_probe_s* nook_gl_probe;

/* Uploads a probe or a grid of lobes, which may be destroyed afterwards. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT (also: the probe is not of lobes), UNSUPPORTED (more texels than a texture buffer of
 * this OpenGL has: 3 + lobes * (1 + probes), of which every OpenGL has 65,536), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_probe_create(nook_gl gl, nook_probe probe, nook_gl_probe* out);

/* Uploads a probe or a grid in place of what is there, such as a bake's next preview; the texture keeps its name. What the
 * GPU still reads stays as it was. Context thread. Errors: as nook_gl_probe_create; on failure the old one stays. */
NOOK_API nook_result nook_gl_probe_update(nook_gl_probe gl_probe, nook_probe probe);

/* Deletes the OpenGL objects and sets *gl_probe to NULL; NULL is fine, and so is a nook_gl that was destroyed before.
 * Context thread, with the OpenGL context of nook_gl_create current (any thread after nook_gl_context_lost). */
NOOK_API void nook_gl_probe_destroy(nook_gl_probe* gl_probe);

typedef struct nook_gl_probe_info {
  uint32_t struct_size; /* sizeof(nook_gl_probe_info), set by the caller */
  uint32_t texture;     /* OpenGL name of a GL_TEXTURE_BUFFER; owned by Nook: bind it, never change or delete it */
  uint64_t bytes;       /* of its buffer */
  const char* glsl;     /* GLSL 3.30 without #version: uniform samplerBuffer nook_probe_texels and the functions above, the
                           same text for every probe. Valid as long as the library is loaded */
} nook_gl_probe_info;
/* Makes no OpenGL call. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_probe_describe(nook_gl_probe gl_probe, nook_gl_probe_info* info);

#ifdef __cplusplus
}
#endif
#endif
