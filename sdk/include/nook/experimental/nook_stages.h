/* The stages of the screen-space pass as data, for graphics APIs other than OpenGL, such as Vulkan or
 * Direct3D. You get the shader texts, descriptions of the images, and the values of the uniform buffers. You
 * create the images and pipelines yourself, and draw the stages. Only nook_nnao_read_timings makes OpenGL
 * calls and needs an OpenGL context. The library must be built with its OpenGL part (NOOK_GL, the default),
 * because it contains the shaders.
 *
 * Once:
 *     nook_nnao_stages stages;
 *     nook_nnao_stages_create(context, &settings, &stages);    the nook_nnao_desc of nook_nnao_create
 *     nook_nnao_stages_describe(stages, &info);                vertex shader, numbers of the network
 *     nook_nnao_stages_describe_image(stages, image, &description);     format and size of each image
 *     nook_nnao_stages_describe_stage(stages, i, &stage);               fragment shader, output, inputs
 * For each frame:
 *     nook_nnao_stages_frame(stages, &frame, &desc, NULL, 0, 0, &values);
 * Then, for each stage of values.drawn_stages in order, draw three vertices without attributes, without
 * blending, depth test and culling, into the viewport of the stage. Add barriers: a stage must end before the
 * next stage reads its output, and a stage must not write an image that the previous frame still reads. The
 * stages write all images except yours as colour attachments, and read them as textures. The initial contents
 * of these images do not matter. samples/vulkan does all this in Vulkan 1.1.
 *
 * The shaders are GLSL 4.50 for Vulkan, and also for OpenGL 4.5. Compile them with `glslangValidator -V`;
 * SPIRV-Cross can convert the result to HLSL or MSL. In set 0, binding 0 is a uniform buffer with
 * nook_nnao_frame_values.constants. In the stage "occlusion", binding 1 is a uniform buffer with
 * nook_nnao_stages_info.network. The input images start at binding 2. Use a sampler without filtering,
 * because the shaders read texels. The output is at location 0.
 *
 * In row 0 of every image, clip y must be -1. In Vulkan, row 0 is the first row; pass the projection that you
 * use in Vulkan. In Direct3D, and in Vulkan with viewports of negative height, clip y is 1 in the first row.
 * There, negate the second row of the projection (elements 1, 5, 9 and 13), and draw the stages with
 * viewports of positive height. Always set frame.clip_space to NOOK_CLIP_SPACE_ZERO_TO_ONE. View space looks
 * along -z. If your view space looks along +z, negate the third column of the projection (elements 8 to 11),
 * and negate z of normals with normal_matrix. */
#ifndef NOOK_STAGES_H
#define NOOK_STAGES_H

#include "../nook_clips.h"
#include "../nook_nnao.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_nnao_stages_s* nook_nnao_stages;

/* Images that stages read or write. You provide the first four, such as your depth image. For passes with
 * views, your images are texture arrays. For passes with depth_samples, the depth image is multisampled. For
 * passes with normal_samples, the normal image is multisampled. If your frames have no such image, bind any 1
 * x 1 image. */
enum {
  NOOK_NNAO_IMAGE_HOST_DEPTH = 0,
  NOOK_NNAO_IMAGE_HOST_NORMAL = 1,
  NOOK_NNAO_IMAGE_HOST_GBUFFER_AO = 2,
  NOOK_NNAO_IMAGE_HOST_MOTION_VECTORS = 3,
  /* This image stores the linear depth of each pixel, as the bits of a float. With normal_samples, it also
   * stores the index of the sample that the depth comes from. */
  NOOK_NNAO_IMAGE_DEPTH = 4,
  /* AO and edges. */
  NOOK_NNAO_IMAGE_AO = 5,
  /* AO and edges after a filter draw. Filter draws write alternately to this image and to
   * NOOK_NNAO_IMAGE_AO. */
  NOOK_NNAO_IMAGE_FILTERED = 6,
  /* These three images exist only with max_history_frames. They hold the mean AO over frames, the linear
   * depth of the previous frame, and the mean AO of the previous frame. After each frame you must swap
   * NOOK_NNAO_IMAGE_DEPTH with NOOK_NNAO_IMAGE_HISTORY_DEPTH, and NOOK_NNAO_IMAGE_ACCUMULATED_AO with
   * NOOK_NNAO_IMAGE_HISTORY_AO. Each view needs its own set of these four images. */
  NOOK_NNAO_IMAGE_ACCUMULATED_AO = 7,
  NOOK_NNAO_IMAGE_HISTORY_DEPTH = 8,
  NOOK_NNAO_IMAGE_HISTORY_AO = 9,
  /* The result, in the format of the pass's own texture. You can use any colour format. Instead of setting
   * frame.blend, you can multiply the result into an image by blending (source * destination). */
  NOOK_NNAO_IMAGE_TARGET = 10,
  NOOK_NNAO_IMAGE_COUNT = 11
};
typedef int32_t nook_nnao_image;

/* Image formats. Their names list the channels, as in DXGI_FORMAT and VkFormat. */
enum {
  /* You provide the image, or no stage uses it. */
  NOOK_NNAO_FORMAT_NONE = 0,
  NOOK_NNAO_FORMAT_R8_UNORM = 1,
  NOOK_NNAO_FORMAT_R8G8_UNORM = 2,
  NOOK_NNAO_FORMAT_R8G8B8A8_UNORM = 3,
  NOOK_NNAO_FORMAT_R32_UINT = 4,
  NOOK_NNAO_FORMAT_R32G32_UINT = 5
};
typedef int32_t nook_nnao_format;

enum {
  /* The maximum number of inputs of a stage. */
  NOOK_NNAO_STAGE_MAX_INPUTS = 6,
  /* The number of floats in nook_nnao_frame_values.constants. */
  NOOK_NNAO_STAGE_CONSTANTS = 80
};

/* Creates a description of the stages of a pass. `path` and `timers` of a nook_nnao_debug_desc have no
 * effect. Networks of the paper's form are not supported. The call allocates. On failure *out is NULL. Any
 * thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_stages_create(nook_context context, const nook_nnao_desc* desc,
                                             nook_nnao_stages* out);

/* Releases the object, which invalidates its texts, and sets *stages to NULL; *stages may be NULL.
 * Any thread. */
NOOK_API void nook_nnao_stages_destroy(nook_nnao_stages* stages);

typedef struct nook_nnao_stages_info {
  uint32_t struct_size;
  uint32_t stage_count;
  /* The vertex shader of every stage; it draws one triangle that covers the viewport. */
  const char* vertex_shader;
  /* The data for binding 1, which never changes. All pointers here are valid while the object lives. */
  const void* network;
  uint32_t network_bytes;
  /* The settings in use, with the preset's value where the descriptor had -1. */
  int32_t taps, half_resolution, blur;
} nook_nnao_stages_info;

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_stages_describe(nook_nnao_stages stages, nook_nnao_stages_info* info);

typedef struct nook_nnao_image_info {
  uint32_t struct_size;
  /* NOOK_NNAO_FORMAT_NONE for your images, and for images that no stage uses. */
  nook_nnao_format format;
  /* Pixels at the pass's maximum size; 0 for your images, and for images that no stage uses. */
  int32_t width, height;
} nook_nnao_image_info;

/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_stages_describe_image(nook_nnao_stages stages, nook_nnao_image image,
                                                     nook_nnao_image_info* info);

typedef struct nook_nnao_stage_info {
  uint32_t struct_size;
  nook_nnao_image output;
  /* `name` is "depth", "depth_apart", "occlusion", "accumulate", "filter_x", "filter_y", "resolve" or
   * "resolve_layered". `fragment_shader` is the text of the stage's fragment shader. Both are valid while the
   * object lives. The first two stages are alternatives: a frame draws "depth_apart" if frame.gbuffer_ao is
   * NOOK_GBUFFER_AO_EXCLUDE, otherwise "depth". The last two are alternatives too: a frame draws "resolve" if
   * frame.gbuffer_ao is NOOK_GBUFFER_AO_NONE, otherwise "resolve_layered".
   * nook_nnao_frame_values.drawn_stages says which stages to draw. */
  const char* name;
  const char* fragment_shader;
  /* 1: the viewport is nook_nnao_frame_values.viewport; 0: the viewport is surface_width x surface_height
   * pixels at (0, 0). */
  int32_t draws_viewport;
  /* 1: the stage reads binding 1. */
  int32_t reads_network;
  uint32_t input_count;
  /* Input i has the binding 2 + i. */
  nook_nnao_image inputs[NOOK_NNAO_STAGE_MAX_INPUTS];
} nook_nnao_stage_info;

/* `index` is less than nook_nnao_stages_info.stage_count.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_stages_describe_stage(nook_nnao_stages stages, uint32_t index,
                                                     nook_nnao_stage_info* info);

typedef struct nook_nnao_frame_values {
  uint32_t struct_size;
  /* The size in pixels of the viewport at the resolution at which AO is computed (the surface). */
  int32_t surface_width, surface_height;
  /* x, y, width and height of the viewport of the last stage. */
  int32_t viewport[4];
  /* The data for binding 0. */
  float constants[NOOK_NNAO_STAGE_CONSTANTS];
  /* Bit i: the frame draws stage i. */
  uint32_t drawn_stages;
} nook_nnao_frame_values;

/* Computes the values of a frame. The result depends only on the arguments, and the call does not allocate.
 * Set frame->normal_texture and desc->motion_vectors to 1 if the frame has such images. The call ignores all
 * other texture names. The call does not know the format of the normals. If normal_bias is not 0, it assumes
 * normalised integers, so the pass reconstructs normals that are shorter than 0.25 from depth. The call does
 * not read `target` and `target_name`, and reads `blend` only with bent normals. The debug view
 * (nook_nnao_frame_debug_desc.show) can be NOOK_NNAO_VIEW_AO or _BLURRED; without max_history_frames also
 * _RAW. `earlier` is the previous frame, or NULL after a cut. `number` is the number of frames before this
 * one. In passes with max_history_frames, `number` changes the noise from frame to frame. `view` is the index
 * of the view, less than nook_nnao_desc.views, or 0.
 * Any thread. Errors: INVALID_ARGUMENT (as nook_nnao_render). */
NOOK_API nook_result nook_nnao_stages_frame(nook_nnao_stages stages, const nook_gl_frame_desc* frame,
                                            const nook_nnao_frame_desc* desc,
                                            const nook_gl_frame_desc* earlier, uint32_t number, uint32_t view,
                                            nook_nnao_frame_values* values);

/* ---- Tables of clips, for hosts without OpenGL ---- */

/* The two textures of an upload of clips; see nook_gl.h. */
enum {
  /* RGBA with signed 8-bit channels (GL_RGBA8_SNORM from GL_BYTE): mode_count / 4 texels for each file
   * vertex. */
  NOOK_CLIPS_MODES = 0,
  /* RGBA, half floats (GL_RGBA16F from GL_HALF_FLOAT): mode_count / 4 texels for each frame. */
  NOOK_CLIPS_WEIGHTS = 1
};
typedef int32_t nook_clips_table;

/* Writes the texels of a table, for a 2D texture of *width x *height texels. Rows follow each other without
 * gaps; the last row is padded with zeros. Set *size to the size of `texels` in bytes; the call sets it to
 * the size of the table. With `texels` NULL, the call only sets *size, *width and *height. The AO of vertex v
 * in frame f is clamp(0.5 + sum of weight * mode, 0, 1), summed over the mode_count weights of f and modes of
 * v. Any thread. Errors: INVALID_ARGUMENT (also if *size is too small). */
NOOK_API nook_result nook_clips_read_table(nook_clips clips, nook_clips_table table, void* texels,
                                           size_t* size, uint32_t* width, uint32_t* height);

/* ---- Memory and time of a pass ---- */

/* Computes the texture memory that a pass will take, before you create it. At 3840 x 2160, a pass takes 75
 * MB, or 25 MB at half resolution; with bent normals, 133 and 58 MB. docs/nnao.md has the bytes for each
 * option. Makes no OpenGL call. Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION. */
NOOK_API nook_result nook_nnao_memory(const nook_nnao_desc* desc, uint64_t* bytes);

/* The GPU time of each stage in the last finished frame, in milliseconds. With nook_nnao_desc.views, these
 * are the times of the last view. */
typedef struct nook_nnao_timings {
  uint32_t struct_size;
  /* 0: no frame is finished yet, or the pass has no timers; all other fields are then 0. */
  int32_t valid;
  /* This stage computes linear depth, and normals for a network of the paper's form. */
  float normals;
  /* These stages evaluate the network, detect edges, read or reconstruct normals, and average over frames. */
  float occlusion;
  /* The stages filter_x and filter_y at half resolution. At full resolution, `resolve` includes the
   * filter. */
  float blur;
  /* This stage filters or upsamples, applies G-buffer AO, and writes the target. */
  float resolve;
  float total;
} nook_nnao_timings;

/* Gives the times of the last finished frame. The call never waits.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_nnao_read_timings(nook_nnao pass, nook_nnao_timings* timings);

#ifdef __cplusplus
}
#endif
#endif
