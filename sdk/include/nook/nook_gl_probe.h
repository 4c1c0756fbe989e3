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
 * largest value. Every name in it begins with nook_ or Nook.
 *
 * A grid for diffuse light alone is smaller and faster as spherical harmonics in a 3D texture of half floats,
 * which the hardware filters: 7 fetches per pixel, 4 for ZH3, at most 40 where walls choose among the probes
 * of ZH3. An engine calls nook_gl_probe_grid_create, puts the GLSL of nook_gl_probe_grid_describe into its
 * shader, sets the uniform nook_grid_texels to a texture unit and the uniform nook_grid_frame to the info's
 * frame, and binds the texture to GL_TEXTURE_3D of that unit, without a sampler object.
 *     vec3 e = nook_grid_irradiance(position_ws, normal_ws);
 *
 * A capture turns cube maps that the engine renders into probes, while the game runs: it creates a probe or a
 * grid as above, of a bake or black, and a capture for it. In a frame it renders the six faces from the place
 * of one probe, or of a few, and calls nook_gl_probe_capture_add for each. Everything happens on the GPU; the
 * same textures have the new light at the next draw. */
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
   * sampler2D) nook_probe_texels and the functions above. The text is the same for every probe and valid as
   * long as the library is loaded. */
  const char* glsl;
} nook_gl_probe_info;

/* Describes the texture. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_probe_describe(nook_gl_probe gl_probe, nook_gl_probe_info* info);

/* ---- Grids of diffuse light in 3D textures ---- */

typedef struct nook_gl_probe_grid_s* nook_gl_probe_grid;

/* The numbers that a grid holds for each probe. */
enum {
  /* Bands 0 to 2 of spherical harmonics, 27 half floats. */
  NOOK_GL_PROBE_GRID_HARMONICS = 0,
  /* ZH3, see nook_probe_harmonics_to_zonal, 15 half floats. */
  NOOK_GL_PROBE_GRID_ZONAL = 1
};
typedef int32_t nook_gl_probe_grid_form;

/* Uploads a probe or a grid of lobes or harmonics, with its walls if it was baked with them; the caller may
 * destroy the probe afterwards. Lobes are projected exactly; bands above 2 are left out. On failure *out is
 * NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT (also, the probe is of ambient dice, or a coefficient is above
 * 65504), UNSUPPORTED (the texture has counts x by counts y by 7 counts z texels, as ZH3 4 counts z, with
 * walls 5 counts z more, and one of these is above GL_MAX_3D_TEXTURE_SIZE, which is 256 or more), GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_probe_grid_create(nook_gl gl, nook_probe probe, nook_gl_probe_grid_form form,
                                               nook_gl_probe_grid* out);

/* Uploads another grid in place of the present one; the texture keeps its name. The frame changes with the
 * grid's box, and the GLSL if one of both has walls and the other has none. On failure the old grid stays.
 * Context thread. Errors: those of nook_gl_probe_grid_create. */
NOOK_API nook_result nook_gl_probe_grid_update(nook_gl_probe_grid grid, nook_probe probe);

/* Deletes the OpenGL objects and sets *grid to NULL; otherwise it is as nook_gl_probe_destroy.
 * Context thread. */
NOOK_API void nook_gl_probe_grid_destroy(nook_gl_probe_grid* grid);

typedef struct nook_gl_probe_grid_info {
  /* sizeof(nook_gl_probe_grid_info); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of a GL_TEXTURE_3D of GL_RGBA16F that Nook owns: the host binds it, and never changes or
   * deletes it. */
  uint32_t texture;
  /* The size of the texture. */
  uint64_t bytes;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions: the uniforms nook_grid_texels and
   * nook_grid_frame, the functions nook_grid_light and nook_grid_irradiance, and those of harmonics. The text
   * is valid until the next update of the grid, or its end. */
  const char* glsl;
  /* The four vec4 of the uniform nook_grid_frame, for glUniform4fv. */
  float frame[16];
  /* 1: walls choose among the probes. */
  int32_t walls;
  /* 0. */
  uint32_t reserved;
} nook_gl_probe_grid_info;

/* Describes the texture. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_probe_grid_describe(nook_gl_probe_grid grid, nook_gl_probe_grid_info* info);

/* ---- Captures: cube maps that the host renders become probes ---- */

typedef struct nook_gl_probe_capture_s* nook_gl_probe_capture;

/* The part of a cube map's light that probes take. */
enum {
  NOOK_GL_PROBE_CAPTURE_ALL = 0,
  /* The map without its suns, which the host draws as lights of their own: texels keep their colour at the
   * luminance of 100 times the mean of the map without suns, as `nook bake probe --direct sky` does.
   * nook_gl_probe_capture_read gives what was taken away. */
  NOOK_GL_PROBE_CAPTURE_SKY = 1
};
typedef int32_t nook_gl_probe_capture_light;

typedef struct nook_gl_probe_capture_desc {
  /* nook_gl_probe_capture_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* The texture whose lobes the capture replaces, or NULL. The lobes are over the sphere. The capture keeps
   * it alive. */
  nook_gl_probe probe;
  /* The 3D texture whose harmonics or ZH3 the capture replaces, or NULL; walls stay as they are. If probe is
   * not NULL, both have the same counts, origin and spacing. At least one of both is needed. */
  nook_gl_probe_grid grid;
  /* Texels, 4 to 512, default 64: the side of a face of every cube map, at the level below. */
  uint32_t face_size_px;
  /* The level of the cube map that is read, at most 15, default 0. A host that renders large faces makes
   * mipmaps and takes the level of 64 texels or less. */
  uint32_t level;
  /* Maps, 1 to 65536, default 1: a probe is the running average of its maps, in which map n has the share
   * 1 / min(n, history). 1 keeps the latest map alone; more smooths noisy maps, or changes of light over
   * frames. */
  uint32_t history;
  /* Default NOOK_GL_PROBE_CAPTURE_ALL. */
  nook_gl_probe_capture_light light;
  /* Of the lobes; default NOOK_PROBE_CONSTRAINT_BANDS. */
  nook_probe_constraint constraint;
  /* Must be 0. */
  uint32_t reserved;
} nook_gl_probe_capture_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_gl_probe_capture_desc_init(nook_gl_probe_capture_desc* desc, size_t size,
                                                     uint32_t header_version);

/* Makes the programs and buffers of a capture: for each probe 16 * 12 bytes for every 12 lobes and 16 * 12
 * for the harmonics, twice, and 2304 bytes for each texel of face_size_px. The textures keep their light
 * until the first map of each probe. On failure *out is NULL and no OpenGL object is left. Context thread.
 * Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED (the sums of all probes exceed the texture buffer of this
 * OpenGL; every OpenGL has room for 2,500 probes of 12 lobes), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_probe_capture_create(nook_gl gl, const nook_gl_probe_capture_desc* desc,
                                                  nook_gl_probe_capture* out);

/* Fits a probe to a cube map of radiance, and writes it to the textures: every texel is a sample, weighted by
 * its solid angle. The lobes are those of NOOK_PROBE_MOMENTS, and the harmonics those of the map; both are
 * computed in 32-bit floats. Nothing is read back, and draws that were issued before still see the old light.
 * index is that of the probe, where x varies fastest, then y, then z. cube_map is the name of a
 * GL_TEXTURE_CUBE_MAP in a format of floats or normalised numbers, rendered from the probe's position with
 * the axes of OpenGL's cube maps as those of the world; the call changes none of its parameters. Texels that
 * are not finite, or above 1e18, do not count; a map of nothing else leaves the probe as it is.
 * Context thread. Errors: INVALID_ARGUMENT (also, the texture is no cube map, or where OpenGL tells sizes and
 * formats, which OpenGL ES does from 3.1 on, has another size, level or format; or the textures were updated
 * with another grid or other lobes), GL. */
NOOK_API nook_result nook_gl_probe_capture_add(nook_gl_probe_capture capture, uint32_t index,
                                               uint32_t cube_map);

/* Makes the next map of a probe its first one, as after a cut or where a light is switched; its light stays
 * until then.
 * Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_probe_capture_reset(nook_gl_probe_capture capture, uint32_t index);

typedef struct nook_gl_probe_capture_result {
  /* sizeof(nook_gl_probe_capture_result); the caller sets it. */
  uint32_t struct_size;
  /* The maps that the average is over, at most desc.history; 0: everything below is 0. */
  uint32_t maps;
  /* Bands 0 to 2 of the light, 9 x RGB in the order of nook_probe_lobes_to_harmonics. */
  float harmonics[27];
  /* With NOOK_GL_PROBE_CAPTURE_SKY: the RGB irradiance of all suns together on a surface that faces them, the
   * unit direction towards the middle of their light, or 0, and their solid angle in steradians. */
  float sun_irradiance[3];
  float sun_direction[3];
  float sun_solid_angle;
  /* The solid angle of the texels that counted, steradians; 4 pi if all did. */
  float used_solid_angle;
  /* 0. */
  uint32_t reserved;
} nook_gl_probe_capture_result;

/* Reads what is known of a probe. The call waits for the GPU.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_gl_probe_capture_read(nook_gl_probe_capture capture, uint32_t index,
                                                nook_gl_probe_capture_result* result);

/* Creates a probe or a grid from the present light, for the CPU or for nook_probe_save: lobes if the capture
 * has desc.probe, else harmonics of order 2. Probes without a map are black. The call waits for the GPU. On
 * failure *out is NULL.
 * Context thread. Errors: INVALID_ARGUMENT, GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_probe_capture_solve(nook_gl_probe_capture capture, nook_probe* out);

/* Deletes the OpenGL objects and sets *capture to NULL; otherwise it is as nook_gl_probe_destroy.
 * Context thread. */
NOOK_API void nook_gl_probe_capture_destroy(nook_gl_probe_capture* capture);

#ifdef __cplusplus
}
#endif
#endif
