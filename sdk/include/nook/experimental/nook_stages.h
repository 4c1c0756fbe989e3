/* The stages of the screen-space pass as data, for graphics interfaces other than OpenGL, such as Vulkan or
 * Direct3D. You get shader text, descriptions of images, and the numbers that the shaders read. You create
 * the images and pipelines, and draw. Only nook_nnao_read_timings makes OpenGL calls and needs an OpenGL
 * context. The library must have been built with its OpenGL half (NOOK_GL, the default), which holds the
 * shaders.
 *
 * Once:
 *     nook_nnao_stages stages;
 *     nook_nnao_stages_create(context, &settings, &stages);    the nook_nnao_desc of nook_nnao_create
 *     nook_nnao_stages_describe(stages, &info);                vertex shader, numbers of the network
 *     nook_nnao_stages_describe_image(stages, image, &description);     format and size of each image
 *     nook_nnao_stages_describe_stage(stages, i, &stage);               fragment shader, output, inputs
 * For each frame:
 *     nook_nnao_stages_frame(stages, &frame, &desc, NULL, 0, 0, &values);
 * and for each stage of values.drawn_stages in order a draw of three vertices without attributes, without
 * blending, depth test and culling, into the viewport of the stage. Each stage ends before the next one reads
 * its output, and after the frame before has read the images that it writes. Every image but the host's is
 * written as a colour attachment and read as a texture; its contents before the first frame do not matter.
 * samples/vulkan does all this in Vulkan 1.1.
 *
 * The shaders are GLSL 4.50 for Vulkan (`glslangValidator -V`, from which SPIRV-Cross makes HLSL or MSL), and
 * of OpenGL 4.5 as well. In set 0, binding 0 is a uniform buffer with nook_nnao_frame_values.constants.
 * Binding 1, only in the stage "occlusion", is a uniform buffer with nook_nnao_stages_info.network. From
 * binding 2 on come the input images, with a sampler that does not filter, because the shaders read texels.
 * Location 0 is the output.
 *
 * Row 0 of every image is where clip y is -1: in Vulkan its first row, with the projection as Vulkan takes
 * it. In Direct3D, and in Vulkan with viewports of negative height, the first row is where clip y is 1.
 * There, negate the second row of the projection (numbers 1, 5, 9 and 13), and draw the stages with viewports
 * of positive height. Always set frame.clip_space to NOOK_CLIP_SPACE_ZERO_TO_ONE. View space looks along -z.
 * If yours looks along +z, negate the third column (numbers 8 to 11), and z of normals by normal_matrix. */
#ifndef NOOK_STAGES_H
#define NOOK_STAGES_H

#include "../nook_clips.h"
#include "../nook_nnao.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_nnao_stages_s* nook_nnao_stages;

/* Images that stages read or write. The first four are the host's: texture arrays for passes with views, and
 * multisampled depth for passes with depth_samples, as well as multisampled normals for those with
 * normal_samples. The host gives the images that its frames have, and any 1 x 1 image for the others. */
enum {
  NOOK_NNAO_IMAGE_HOST_DEPTH = 0,
  NOOK_NNAO_IMAGE_HOST_NORMAL = 1,
  NOOK_NNAO_IMAGE_HOST_GBUFFER_AO = 2,
  NOOK_NNAO_IMAGE_HOST_MOTION_VECTORS = 3,
  /* Linear depth of the surface, as the bits of floats, and with normal_samples the number of its sample. */
  NOOK_NNAO_IMAGE_DEPTH = 4,
  /* AO and edges. */
  NOOK_NNAO_IMAGE_AO = 5,
  /* The same after filters; with two of them AO is written anew by the second. */
  NOOK_NNAO_IMAGE_FILTERED = 6,
  /* With max_history_frames: the mean over frames, and what it and linear depth were in the frame before.
   * After each frame you must swap NOOK_NNAO_IMAGE_DEPTH with NOOK_NNAO_IMAGE_HISTORY_DEPTH, and
   * NOOK_NNAO_IMAGE_ACCUMULATED_AO with NOOK_NNAO_IMAGE_HISTORY_AO. Each view has its own four images of this
   * kind. */
  NOOK_NNAO_IMAGE_ACCUMULATED_AO = 7,
  NOOK_NNAO_IMAGE_HISTORY_DEPTH = 8,
  NOOK_NNAO_IMAGE_HISTORY_AO = 9,
  /* The result, in the format of the pass's own texture. Any colour format will do, and blending source times
     destination multiplies it, in place of frame.blend. */
  NOOK_NNAO_IMAGE_TARGET = 10,
  NOOK_NNAO_IMAGE_COUNT = 11
};
typedef int32_t nook_nnao_image;

/* Formats by their channels, as DXGI_FORMAT and VkFormat name them. */
enum {
  /* The host's, or the image does not exist. */
  NOOK_NNAO_FORMAT_NONE = 0,
  NOOK_NNAO_FORMAT_R8_UNORM = 1,
  NOOK_NNAO_FORMAT_R8G8_UNORM = 2,
  NOOK_NNAO_FORMAT_R8G8B8A8_UNORM = 3,
  NOOK_NNAO_FORMAT_R32_UINT = 4,
  NOOK_NNAO_FORMAT_R32G32_UINT = 5
};
typedef int32_t nook_nnao_format;

enum {
  /* The most inputs of a stage. */
  NOOK_NNAO_STAGE_MAX_INPUTS = 6,
  /* Floats of nook_nnao_frame_values.constants. */
  NOOK_NNAO_STAGE_CONSTANTS = 80
};

/* Describes the stages of a pass. path and timers of a nook_nnao_debug_desc have no effect. Not with a
 * network of the paper's form. It allocates; on failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT,
 * BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_stages_create(nook_context context, const nook_nnao_desc* desc,
                                             nook_nnao_stages* out);

/* Releases the object and its texts, and sets *stages to NULL; *stages may be NULL.
 * Any thread. */
NOOK_API void nook_nnao_stages_destroy(nook_nnao_stages* stages);

typedef struct nook_nnao_stages_info {
  uint32_t struct_size;
  uint32_t stage_count;
  /* Of every stage: one triangle over the viewport. */
  const char* vertex_shader;
  /* The numbers of binding 1, which never change. Pointers are valid while the object lives. */
  const void* network;
  uint32_t network_bytes;
  /* The preset's numbers, where the descriptor had -1. */
  int32_t taps, half_resolution, blur;
} nook_nnao_stages_info;

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_stages_describe(nook_nnao_stages stages, nook_nnao_stages_info* info);

typedef struct nook_nnao_image_info {
  uint32_t struct_size;
  /* NOOK_NNAO_FORMAT_NONE for images of the host, and for images that no stage uses. */
  nook_nnao_format format;
  /* Pixels at the pass's maximum size; 0 for images of the host, and for images that no stage uses. */
  int32_t width, height;
} nook_nnao_image_info;

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_stages_describe_image(nook_nnao_stages stages, nook_nnao_image image,
                                                     nook_nnao_image_info* info);

typedef struct nook_nnao_stage_info {
  uint32_t struct_size;
  nook_nnao_image output;
  /* "depth", "depth_apart", "occlusion", "accumulate", "filter_x", "filter_y", "resolve" or
   * "resolve_layered", and the text of its fragment shader; valid while the object lives. The first two
   * stages are depth and depth_apart: a frame runs the second if frame.gbuffer_ao is NOOK_GBUFFER_AO_EXCLUDE,
   * and the first otherwise. The last two are resolve and resolve_layered: a frame runs the first if
   * frame.gbuffer_ao is NOOK_GBUFFER_AO_NONE, and the second otherwise. nook_nnao_frame_values.drawn_stages
   * has the choice. */
  const char* name;
  const char* fragment_shader;
  /* 1: the viewport is nook_nnao_frame_values.viewport; 0: it is surface_width x surface_height at (0, 0). */
  int32_t draws_viewport;
  /* 1: it reads binding 1. */
  int32_t reads_network;
  uint32_t input_count;
  /* Input i has the binding 2 + i. */
  nook_nnao_image inputs[NOOK_NNAO_STAGE_MAX_INPUTS];
} nook_nnao_stage_info;

/* index is less than nook_nnao_stages_info.stage_count.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_stages_describe_stage(nook_nnao_stages stages, uint32_t index,
                                                     nook_nnao_stage_info* info);

typedef struct nook_nnao_frame_values {
  uint32_t struct_size;
  /* Pixels of the surface, which is the viewport at the resolution at which AO is computed. */
  int32_t surface_width, surface_height;
  /* x, y, width and height of the last stage. */
  int32_t viewport[4];
  /* Binding 0. */
  float constants[NOOK_NNAO_STAGE_CONSTANTS];
  /* Bit i: the frame draws stage i. */
  uint32_t drawn_stages;
} nook_nnao_frame_values;

/* Computes the numbers of a frame. It depends on its arguments alone, and allocates nothing.
 * Set frame->normal_texture and desc->motion_vectors to 1 if the frame has such images; no other texture name
 * is read. The call cannot see the format of the normals: with a normal_bias other than 0 it takes them as
 * normalised integers, where a normal shorter than 0.25 is reconstructed from depth.
 * target and target_name are not read, and blend only with bent normals. desc->show is
 * NOOK_NNAO_VIEW_AO, RAW or BLURRED, and RAW only without max_history_frames.
 * earlier: the frame before, or NULL for a cut. number: the count of frames before, which turns the noise of
 * passes with max_history_frames. view: less than nook_nnao_desc.views, or 0.
 * Any thread. Errors: INVALID_ARGUMENT (as nook_nnao_render). */
NOOK_API nook_result nook_nnao_stages_frame(nook_nnao_stages stages, const nook_gl_frame_desc* frame,
                                            const nook_nnao_frame_desc* desc,
                                            const nook_gl_frame_desc* earlier, uint32_t number, uint32_t view,
                                            nook_nnao_frame_values* values);

/* ---- Tables of clips, for hosts without OpenGL ---- */

/* The textures of nook_gl.h. */
enum {
  /* RGBA, 8 bits with sign (GL_RGBA8_SNORM from GL_BYTE): mode_count / 4 texels for each file vertex. */
  NOOK_CLIPS_MODES = 0,
  /* RGBA, half floats (GL_RGBA16F from GL_HALF_FLOAT): mode_count / 4 texels for each frame. */
  NOOK_CLIPS_WEIGHTS = 1
};
typedef int32_t nook_clips_table;

/* Writes the texels of a table, for a 2D texture of *width x *height texels: rows one after another without
 * gaps, the last one filled up with zeros. *size is the room in bytes, and becomes the size of the table;
 * with texels NULL the call only sets *size, *width and *height. The AO of vertex v in frame f is clamp(0.5 +
 * sum of weight * mode over the mode_count numbers of each, 0, 1). Any thread. Errors: INVALID_ARGUMENT
 * (also, there is too little room). */
NOOK_API nook_result nook_clips_read_table(nook_clips clips, nook_clips_table table, void* texels,
                                           size_t* size, uint32_t* width, uint32_t* height);

/* ---- Memory and time of a pass ---- */

/* Computes the texture memory that a pass will take, before you create it: 75 MB at 3840 x 2160, 25 MB at
 * half resolution, 133 and 58 MB with bent normals. docs/nnao.md has the bytes for each option. Makes no
 * OpenGL call. Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION. */
NOOK_API nook_result nook_nnao_memory(const nook_nnao_desc* desc, uint64_t* bytes);

/* The time that the GPU took for each stage of the newest finished frame, in milliseconds; with
 * nook_nnao_desc.views, for the last view. */
typedef struct nook_nnao_timings {
  uint32_t struct_size;
  /* 0: no frame is finished yet, or the pass has no timers; the other members are 0 then. */
  int32_t valid;
  /* Linear depth, and the normals of the paper's form. */
  float normals;
  /* The network, edges, reading or reconstructing normals, and the mean over frames. */
  float occlusion;
  /* The filter at half resolution; at full resolution it is a part of resolve. */
  float blur;
  /* Filter or upsample, G-buffer AO and target. */
  float resolve;
  float total;
} nook_nnao_timings;

/* Gives the newest times; the call never waits.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_nnao_read_timings(nook_nnao pass, nook_nnao_timings* timings);

#ifdef __cplusplus
}
#endif
#endif
