/* Recorded frames of the screen-space pass. One .nook file holds the depth, normals, matrices and settings of
 * one frame, and the AO that the pass computed from them. `nook evaluate nnao --frame FILE.nook` draws the
 * frame again on another machine, and `nook inspect FILE.nook` lists the contents.
 *
 * nook_nnao_record records a frame in OpenGL. In tools and with other graphics APIs, fill
 * nook_nnao_recording_desc yourself. Only nook_nnao_record makes OpenGL calls.
 *     nook_nnao_recording recording;
 *     size_t size = 0;
 *     nook_nnao_record(nnao, &frame, &nnao_frame, "floor too dark", &recording);
 *     nook_nnao_recording_save(recording, NULL, &size);
 *     nook_nnao_recording_save(recording, bytes = malloc(size), &size);
 *     nook_nnao_recording_destroy(&recording);
 * Then write the file. To avoid incomplete files, write the bytes to a temporary file in the same folder and
 * rename it. nook::Recording::write of nook.hpp does this.
 *
 * A recording contains no colour image of the scene, but its depth and normals show shapes. Tell this to
 * everyone who sends you a recording. */
#ifndef NOOK_RECORDING_H
#define NOOK_RECORDING_H

#include "../nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_nnao_recording_s* nook_nnao_recording;

/* The contents of a recording. Images have width x height texels, row by row, starting with the row where
 * clip y is -1. Each image contains only the part of your own image that `projection` covers. The fields of
 * the frame and of the pass have the same meaning, ranges and constants as in nook_gl_frame_desc (nook_gl.h),
 * nook_nnao_frame_desc and nook_nnao_desc (nook_nnao.h). */
typedef struct nook_nnao_recording_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Pixels, 1 to 16384; required. */
  int32_t width, height;
  /* Required: the texels of the depth texture, as a shader reads them. Any values are allowed. */
  const float* depth;
  /* Three floats for each texel, as a shader reads them from the normal texture. Any values are allowed. If
   * NULL, the pass reconstructs normals. */
  const float* normals;
  /* Two floats for each texel: red and green of the G-buffer AO. Any values are allowed. Required if `layer`
   * is not 0. */
  const float* layer_texels;
  /* The AO of the frame in [0, 1], as the pass writes it to its own texture; NULL if you have none. */
  const float* ao;
  /* The fields from here to `view` describe the frame. `depth_kind` is 0 for hardware depth, 1 for linear
   * depth. `clip` is a nook_clip_space: 0 for -1 to 1, 1 for 0 to 1. `projection` and `radius` are
   * required. */
  int32_t depth_kind;
  int32_t clip;
  float sky_depth;
  float normal_scale, normal_bias;
  float normal_matrix[9];
  float projection[16];
  float radius;
  float max_radius_px;
  float intensity, power;
  /* A value of nook_gbuffer_ao: 0 none, 1 min, 2 remainder, 3 replace, 4 exclude. */
  int32_t layer;
  /* The contents of `ao`, a value of nook_nnao_view: 0 the result, 1 raw, 2 blurred. */
  int32_t view;
  /* The fields from here to `path` are the settings of the pass. `path` is 0 for unknown, 1 for fragment, 2
   * for compute. */
  int32_t taps;
  int32_t half_resolution;
  int32_t blur;
  float blur_sharpness;
  int32_t path;
  /* The nook_version() of the library that computed `ao`; 0: the version of this library. */
  uint32_t library_version;
  /* The bytes of the .nook file of the network. NULL (default): the network that is embedded in this
   * library. */
  const void* network;
  /* The size of `network` in bytes. */
  size_t network_size;
  /* GL_VENDOR, GL_RENDERER and GL_VERSION, or similar names from another graphics API; and a note of your
   * own. UTF-8 without control characters, at most 1000 bytes each. NULL means empty. */
  const char* vendor;
  const char* renderer;
  const char* driver_version;
  const char* note;
  /* 0 (default): `radius` is in metres; 1: `radius` is a fraction of the height. */
  int32_t radius_kind;
  /* As in nook_nnao_frame_desc. With the default 0, there is no minimum and no fade. */
  float min_radius_px, fade_begin, fade_end;
} nook_nnao_recording_desc;
static inline nook_result nook_nnao_recording_desc_init(nook_nnao_recording_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO_RECORDING, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a recording. The call copies everything. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (the message names the field, its value and what is needed), BAD_FILE
 * (`network` is not the file of a network), OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_recording_create(nook_context context, const nook_nnao_recording_desc* desc,
                                                nook_nnao_recording* out);

/* Loads a recording from the bytes of a .nook file, which you may free afterwards. The library validates
 * everything, so you can load files that you do not trust. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_recording_load(nook_context context, const void* bytes, size_t size,
                                              nook_nnao_recording* out);

/* Releases your reference and sets *recording to NULL.
 * Any thread. */
NOOK_API void nook_nnao_recording_destroy(nook_nnao_recording* recording);

/* Writes the .nook file of a recording to `bytes`. Set *size to the buffer's size; the call sets it to the
 * file's size. With `bytes` NULL, the call only sets *size. Storage is lossless. Each value of an image takes
 * 4 bytes, or fewer if a smaller format stores all values of this image exactly, for example 24-bit depth or
 * 10-bit normals. The call allocates from the C++ heap. Any thread. Errors: INVALID_ARGUMENT (also if the
 * buffer is too small; *size is then the required size), OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_recording_save(nook_nnao_recording recording, void* bytes, size_t* size);

/* Fills *desc with the contents of the recording. If you pass *desc to nook_nnao_recording_create, you get an
 * equal recording. Set desc->struct_size to sizeof *desc before the call. The pointers are valid while the
 * recording lives. The texts are never NULL. `network` is NULL if the recording does not contain a network.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_recording_describe(nook_nnao_recording recording,
                                                  nook_nnao_recording_desc* desc);

struct nook_gl_frame_desc;
struct nook_nnao_frame_desc;

/* Records a frame: draws its AO into the pass's own texture, and reads the AO back together with the depth,
 * the normals and the G-buffer AO of the frame. The call ignores `blend`, `target` and `target_name`, and
 * does not write to your target. If the debug view is NOOK_NNAO_VIEW_NORMALS, the call records the result
 * (NOOK_NNAO_VIEW_AO) instead. The call converts logarithmic depth to linear depth, and a radius relative to
 * the scene to metres. `note` is a text for the person who opens the file, or NULL. You can call this
 * function before or after nook_nnao_render of the same frame. The call WAITS FOR THE GPU, allocates, and
 * creates a program, so use it only for bug reports and measurements. The call does not support passes with
 * depth_samples or views. On failure *out is NULL.
 * Context thread. Errors: INVALID_ARGUMENT (as nook_nnao_render; also if the note is longer than 1000 bytes
 * or has control characters), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_record(nook_nnao pass, const struct nook_gl_frame_desc* frame,
                                      const struct nook_nnao_frame_desc* desc, const char* note,
                                      nook_nnao_recording* out);

#ifdef __cplusplus
}
#endif
#endif
