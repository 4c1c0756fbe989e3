/* Recorded frames of the screen-space pass. One .nook file has the depth, normals, matrices and settings of
 * one frame, and the AO that the pass made of them. `nook evaluate nnao --frame FILE.nook` draws the frame
 * anew on another machine, and `nook inspect FILE.nook` lists what it holds.
 *
 * nook_nnao_record records a frame of OpenGL. A host with another graphics interface, or a tool, fills
 * nook_nnao_recording_desc itself. Only nook_nnao_record makes OpenGL calls.
 *     nook_nnao_recording recording;
 *     size_t size = 0;
 *     nook_nnao_record(nnao, &frame, &nnao_frame, "floor too dark", &recording);
 *     nook_nnao_recording_save(recording, NULL, &size);
 *     nook_nnao_recording_save(recording, bytes = malloc(size), &size);
 *     nook_nnao_recording_destroy(&recording);
 * You write the file: write the bytes to another name beside it and rename that, so that no half file
 * appears. nook.hpp has this as nook::Recording::write.
 *
 * A recording contains no picture of the scene, but its depth and normals show shapes. Whoever sends it
 * should know that. */
#ifndef NOOK_RECORDING_H
#define NOOK_RECORDING_H

#include "../nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_nnao_recording_s* nook_nnao_recording;

/* The contents of a recording. Images have width x height texels, row by row from the one where clip y is -1,
 * x first; they are the part of the host's images that the projection fills. The members of the frame and of
 * the pass have the meaning, the ranges and the constants of nook_gl_frame_desc (nook_gl.h),
 * nook_nnao_frame_desc and nook_nnao_desc (nook_nnao.h). */
typedef struct nook_nnao_recording_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Pixels, 1 to 16384; required. */
  int32_t width, height;
  /* Required: the texels of the depth texture as a shader reads them, any numbers. */
  const float* depth;
  /* Three floats for each texel, as a shader reads them from the normal texture, any numbers. NULL: none; the
   * pass reconstructs normals. */
  const float* normals;
  /* Two floats for each texel: the red and the green channel of the G-buffer AO, any numbers. Required if
   * layer is not 0. */
  const float* layer_texels;
  /* The AO of the frame, as the pass writes it to its own texture, in [0, 1]. NULL: none. */
  const float* ao;
  /* The frame. depth_kind: 0 hardware depth, 1 linear depth. clip, a nook_clip_space: 0 from -1 to 1, 1 from
   * 0 to 1. projection and radius are required. */
  int32_t depth_kind;
  int32_t clip;
  float sky_depth;
  float normal_scale, normal_bias;
  float normal_matrix[9];
  float projection[16];
  float radius;
  float max_radius_px;
  float intensity, power;
  /* A nook_gbuffer_ao: 0 none, 1 min, 2 remainder, 3 replace, 4 exclude. */
  int32_t layer;
  /* The quantity that ao holds, a nook_nnao_view: 0 the result, 1 raw, 2 blurred. */
  int32_t view;
  /* The pass. path: 0 unknown, 1 fragment, 2 compute. */
  int32_t taps;
  int32_t half_resolution;
  int32_t blur;
  float blur_sharpness;
  int32_t path;
  /* The nook_version() of the library that made ao; 0: this library's. */
  uint32_t library_version;
  /* The bytes of the .nook file of the network. NULL (default): the one that is embedded in this library. */
  const void* network;
  /* The size of network in bytes. */
  size_t network_size;
  /* GL_VENDOR, GL_RENDERER and GL_VERSION, or what names the driver in another interface; and a remark of the
   * host. UTF-8 without control characters, at most 1000 bytes each. NULL: empty. */
  const char* vendor;
  const char* renderer;
  const char* driver_version;
  const char* note;
  /* 0 (default): radius is in metres; 1: it is a share of the height. */
  int32_t radius_kind;
  /* As in the frame; default 0: none. */
  float min_radius_px, fade_begin, fade_end;
} nook_nnao_recording_desc;
static inline nook_result nook_nnao_recording_desc_init(nook_nnao_recording_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO_RECORDING, desc, sizeof *desc, NOOK_VERSION);
}

/* Makes a recording; it copies everything. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the field, its value and what is needed), BAD_FILE
 * (network is no network's file), OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_recording_create(nook_context context, const nook_nnao_recording_desc* desc,
                                                nook_nnao_recording* out);

/* Loads a recording from the bytes of a .nook file; the caller may free the bytes afterwards. The library
 * validates everything, so that hostile bytes are safe. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_recording_load(nook_context context, const void* bytes, size_t size,
                                              nook_nnao_recording* out);

/* Releases the caller's reference and sets *recording to NULL.
 * Any thread. */
NOOK_API void nook_nnao_recording_destroy(nook_nnao_recording* recording);

/* Writes the .nook file of a recording to bytes; the host stores it. *size is the buffer's size before the
 * call and the file's size afterwards. With bytes NULL the call gives only the size. A number of an image
 * takes 4 bytes, or 1 to 3 if these hold all numbers of the image exactly. They do for depth with 24 bits or
 * normals with 10. Every number comes back with the same bits. It allocates from the C++ heap. Any thread.
 * Errors: INVALID_ARGUMENT (also, the buffer is too small; *size is then the required size), OUT_OF_MEMORY.
 * */
NOOK_API nook_result nook_nnao_recording_save(nook_nnao_recording recording, void* bytes, size_t* size);

/* Fills *desc with what the recording holds, so that nook_nnao_recording_create makes an equal one of it. The
 * caller sets desc->struct_size to sizeof *desc before. The pointers are valid while the recording lives; no
 * text is NULL. network is NULL if the recording holds none.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_recording_describe(nook_nnao_recording recording,
                                                  nook_nnao_recording_desc* desc);

struct nook_gl_frame_desc;
struct nook_nnao_frame_desc;

/* Records a frame: draws its AO into the pass's own texture, and reads that back with the depth, the normals
 * and the G-buffer AO of the frame. Blend, target and target_name have no effect: no target of the host is
 * written. NOOK_NNAO_VIEW_NORMALS records the result. Logarithmic depth is recorded as the linear depth that
 * follows from it, and a share of the scene as metres. note is a remark for whoever opens the file, or NULL.
 * The call may stand before nook_nnao_render of the same frame or after it. It WAITS FOR THE GPU, allocates,
 * and makes a program: it is meant for reports of errors and for measurements. It is not for passes with
 * depth_samples or views. On failure *out is NULL. Context thread. Errors: INVALID_ARGUMENT (as
 * nook_nnao_render; also, the note is longer than 1000 bytes or has control characters), GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_record(nook_nnao pass, const struct nook_gl_frame_desc* frame,
                                      const struct nook_nnao_frame_desc* desc, const char* note,
                                      nook_nnao_recording* out);

#ifdef __cplusplus
}
#endif
#endif
