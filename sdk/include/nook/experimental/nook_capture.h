/* Captures: cube maps that the engine renders become probes while the game runs. */
#ifndef NOOK_CAPTURE_H
#define NOOK_CAPTURE_H

#include "../nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Captures: cube maps that the host renders become probes ---- */

typedef struct nook_gl_capture_s* nook_gl_capture;

/* The part of a cube map's light that probes take. */
enum {
  NOOK_GL_CAPTURE_ALL = 0,
  /* Leaves out the suns, which you draw as separate lights: their texels keep their colour, at 100 times the
   * mean luminance of the map without suns, as with `nook bake probe --direct sky`. nook_gl_capture_read
   * gives what was taken away. */
  NOOK_GL_CAPTURE_SKY = 1
};
typedef int32_t nook_gl_capture_light;

typedef struct nook_gl_capture_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The upload of form NOOK_GL_PROBE_LOBES whose lobes the capture replaces, or NULL. The lobes are over the
   * sphere. The capture keeps it alive. */
  nook_gl_upload probe;
  /* The upload of form NOOK_GL_PROBE_SH or NOOK_GL_PROBE_ZH3 whose harmonics or ZH3 the capture replaces, or
   * NULL; walls stay as they are. If probe is not NULL, both have the same counts, origin and spacing. At
   * least one of them is needed. */
  nook_gl_upload grid;
  /* Texels, 4 to 512, default 64: the side of a face of every cube map, at the level below. */
  uint32_t face_size_px;
  /* The level of the cube map that is read, at most 15, default 0. A host that renders large faces makes
   * mipmaps and takes the level of 64 texels or less. */
  uint32_t level;
  /* Maps, 1 to 65536, default 1: a probe is the running average of its maps, in which map n has the share
   * 1 / min(n, history). 1 keeps only the latest map. A larger number smooths noisy maps, and changes of
   * light over frames. */
  uint32_t history;
  /* Default NOOK_GL_CAPTURE_ALL. */
  nook_gl_capture_light light;
  /* 1 (default): the lobes agree with the light in spherical harmonics of bands 0 to 2, as in
   * nook_probe_fit_desc. 0: moments alone. */
  int32_t match_sh;
  uint32_t reserved;
} nook_gl_capture_desc;
static inline nook_result nook_gl_capture_desc_init(nook_gl_capture_desc* desc) {
  return nook_desc_init(NOOK_DESC_GL_CAPTURE, desc, sizeof *desc, NOOK_VERSION);
}

/* Makes the programs and buffers of a capture: for each probe 16 * 12 bytes for every 12 lobes and 16 * 12
 * for the harmonics, twice, and 2304 bytes for each texel of face_size_px. The textures keep their light
 * until the first map of each probe. On failure *out is NULL and no OpenGL object is left. Context thread.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (the sums of all probes exceed the texture buffer of this OpenGL;
 * every OpenGL has room for 2,500 probes of 12 lobes), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_capture_create(nook_gl gl, const nook_gl_capture_desc* desc,
                                            nook_gl_capture* out);

/* Fits a probe to a cube map of radiance, and writes it to the textures: every texel is a sample, weighted by
 * its solid angle. Lobes are fitted as NOOK_PROBE_FIT_STUDY_MOMENTS does (nook_sg.h), and harmonics are
 * projected from the map, both in 32-bit floats. Nothing is read back, and draws that were issued before
 * still see the old light. index is the probe's number; x varies fastest, then y, then z. cube_map is the
 * name of a GL_TEXTURE_CUBE_MAP in a format of floats or normalised numbers. Render it from the probe's
 * position, with OpenGL's cube map axes along the axes of the world. The call changes none of its parameters.
 * Texels that are not finite, or above 1e18, do not count; a map of nothing else leaves the probe as it is.
 * restart 1 makes this map the first one of the average, as after a cut or where a light is switched; 0
 * averages it with the earlier maps. Context thread. Errors: INVALID_ARGUMENT (also, the texture is no cube
 * map, or where OpenGL tells sizes and formats, which OpenGL ES does from 3.1 on, has another size, level or
 * format; or the textures were updated with another grid or other lobes), GL. */
NOOK_API nook_result nook_gl_capture_add(nook_gl_capture capture, uint32_t index, uint32_t cube_map,
                                         int32_t restart);

typedef struct nook_gl_capture_info {
  uint32_t struct_size;
  /* The maps that the average is over, at most desc.history; 0: everything below is 0. */
  uint32_t maps;
  /* Bands 0 to 2 of the light, 9 x RGB in the order of nook_sg_to_sh. */
  float harmonics[27];
  /* With NOOK_GL_CAPTURE_SKY, these describe all suns together: the RGB irradiance on a surface that faces
     them, the unit direction to the middle of their light (or 0), and their solid angle in steradians. */
  float sun_irradiance[3];
  float sun_direction[3];
  float sun_solid_angle;
  /* The solid angle of the texels that counted, steradians; 4 pi if all did. */
  float used_solid_angle;
  /* 0. */
  uint32_t reserved;
} nook_gl_capture_info;

/* Reads what is known of a probe. The call waits for the GPU.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_gl_capture_read(nook_gl_capture capture, uint32_t index,
                                          nook_gl_capture_info* result);

/* Creates a probe or a grid from the present light, for the CPU or for nook_probe_save: lobes if the capture
 * has desc.probe, else harmonics of order 2. Probes without a map are black. The call waits for the GPU. On
 * failure *out is NULL.
 * Context thread. Errors: INVALID_ARGUMENT, GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_capture_solve(nook_gl_capture capture, nook_probe* out);

/* Deletes the OpenGL objects and sets *capture to NULL; otherwise it is as
 * nook_gl_upload_destroy.
 * Context thread. */
NOOK_API void nook_gl_capture_destroy(nook_gl_capture* capture);

#ifdef __cplusplus
}
#endif
#endif
