/* A capture computes probes from cube maps that your engine renders while the game runs. */
#ifndef NOOK_CAPTURE_H
#define NOOK_CAPTURE_H

#include "../nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Captures ---- */

typedef struct nook_gl_capture_s* nook_gl_capture;

/* Which part of a cube map's light goes into the probes. */
enum {
  NOOK_GL_CAPTURE_ALL = 0,
  /* Leaves out the suns, so that you can draw them as separate lights. Sun texels keep their colour, but the
   * capture reduces their luminance to 100 times the mean luminance of the map without suns, as with `nook
   * bake probe --direct sky`. nook_gl_capture_read returns the removed light. */
  NOOK_GL_CAPTURE_SKY = 1
};
typedef int32_t nook_gl_capture_light;

typedef struct nook_gl_capture_desc {
  uint32_t struct_size, type;
  const void* next;
  /* An upload of the form NOOK_GL_PROBE_LOBES whose lobes the capture replaces, or NULL. The domain of the
   * upload must be the sphere. The capture keeps the upload alive. */
  nook_gl_upload probe;
  /* An upload of the form NOOK_GL_PROBE_SH or NOOK_GL_PROBE_ZH3 whose coefficients the capture replaces, or
   * NULL. The capture does not change the walls of the grid. Set at least one of `probe` and `grid`. If you
   * set both, they must have the same counts, origin and spacing. */
  nook_gl_upload grid;
  /* The side length of a cube-map face at mipmap level `level`: 4 to 512 texels, default 64. */
  uint32_t face_size_px;
  /* The mipmap level of the cube map that the capture reads, at most 15, default 0. If you render large
   * faces, generate mipmaps and use the level with 64 texels or less. */
  uint32_t level;
  /* The length of a probe's running average over cube maps, 1 to 65536 maps. When you add map n, it gets the
   * weight 1 / min(n, history). With the default 1, the probe only uses the latest map. A larger value
   * smooths noisy maps, and also smooths changes of light over time. */
  uint32_t history;
  /* Default NOOK_GL_CAPTURE_ALL. */
  nook_gl_capture_light light;
  /* 1 (default): the lobes match the light's spherical harmonics of bands 0 to 2, as in nook_probe_fit_desc.
   * 0: the lobes are fitted without this constraint, as with NOOK_PROBE_FIT_STUDY_MOMENTS (nook_sg.h). */
  int32_t match_sh;
  uint32_t reserved;
} nook_gl_capture_desc;
static inline nook_result nook_gl_capture_desc_init(nook_gl_capture_desc* desc) {
  return nook_desc_init(NOOK_DESC_GL_CAPTURE, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates the programs and buffers of a capture. They take 384 bytes per probe for every 12 lobes, 384 bytes
 * per probe for harmonics, and face_size_px * 2304 bytes for the capture. The textures keep the old light of
 * a probe until you add the first map for this probe. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the data of all probes exceeds the largest texture
 * buffer of this OpenGL; 2,500 probes of 12 lobes always fit), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_capture_create(nook_gl gl, const nook_gl_capture_desc* desc,
                                            nook_gl_capture* out);

/* Fits a probe to a cube map of radiance, and writes the probe to the textures. Every texel is a sample,
 * weighted by its solid angle. Lobes are fitted as with NOOK_PROBE_FIT_STUDY_MOMENTS (nook_sg.h), and
 * harmonics are projected from the map, both in 32-bit floats. The call reads nothing back to the CPU. Draws
 * that you issued before the call still use the old light. `index` is the probe's index; x varies fastest,
 * then y, then z. `cube_map` is the name of a GL_TEXTURE_CUBE_MAP in a float or normalised format. Render it
 * from the probe's position, with OpenGL's cube map axes along the world axes. The call does not change
 * texture parameters. Texels that are not finite or are above 1e18 are ignored; if all texels are ignored,
 * the probe is not changed. With `restart` 1, the average starts again with this map; use it after a cut or
 * when a light is switched. With `restart` 0, the map is averaged with the earlier maps.
 * Context thread. Errors: INVALID_ARGUMENT (also if the texture is not a cube map; if its size, level or
 * format is wrong, which Nook cannot check on OpenGL ES 3.0; or if you updated the textures with another
 * grid or other lobes), GL. */
NOOK_API nook_result nook_gl_capture_add(nook_gl_capture capture, uint32_t index, uint32_t cube_map,
                                         int32_t restart);

typedef struct nook_gl_capture_info {
  uint32_t struct_size;
  /* The number of maps in the average, at most desc.history. If 0, all fields below are 0. */
  uint32_t maps;
  /* The spherical harmonics of the light, bands 0 to 2: 9 x RGB in the order of nook_sg_to_sh. */
  float harmonics[27];
  /* With NOOK_GL_CAPTURE_SKY, these fields describe all suns together. The fields are the RGB irradiance on a
   * surface that faces the suns, the unit direction to the centre of their light (or 0), and their solid
   * angle in steradians. */
  float sun_irradiance[3];
  float sun_direction[3];
  float sun_solid_angle;
  /* The solid angle of the texels that were used, in steradians; 4 pi if all were used. */
  float used_solid_angle;
  /* 0. */
  uint32_t reserved;
} nook_gl_capture_info;

/* Reads the state of a probe. The call waits for the GPU.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_gl_capture_read(nook_gl_capture capture, uint32_t index,
                                          nook_gl_capture_info* result);

/* Creates a probe or a grid from the current light, for the CPU or for nook_probe_save. Its basis is lobes if
 * the capture has desc.probe, otherwise harmonics of order 2. Probes without a map are black. The call waits
 * for the GPU. On failure *out is NULL.
 * Context thread. Errors: INVALID_ARGUMENT, GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_capture_solve(nook_gl_capture capture, nook_probe* out);

/* Deletes the OpenGL objects and sets *capture to NULL, under the same conditions as nook_gl_upload_destroy.
 * Context thread. */
NOOK_API void nook_gl_capture_destroy(nook_gl_capture* capture);

#ifdef __cplusplus
}
#endif
#endif
