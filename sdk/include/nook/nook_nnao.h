/* Screen-space ambient occlusion by a small neural network. The input is a depth buffer, and normals if the
 * host has them; the output is AO in a texture, or AO multiplied into an image of the host. The one required
 * parameter is the radius.
 *
 * The method is that of D. Holden, J. Saito and T. Komura, Neural Network Ambient Occlusion, 2016. With x the
 * features of the pixels around one pixel, AO = L3(L2(L1(L0(x)))), where Ln(x) = PReLU(Wn x + bn) and
 * PReLU(x) = b max(x, 0) + a min(x, 0). The embedded network reads x along directions on the screen (the
 * horizon form). A network of the paper's form, which reads x over a grid of 31 x 31 pixels, can be loaded
 * instead. Both are trained on the cosine-weighted visibility of the hemisphere around the normal, up to the
 * distance of the radius.
 *
 * Each frame, after the host has drawn depth and before it lights:
 *     nook_nnao_frame_desc frame;
 *     nook_nnao_frame_desc_init(&frame, sizeof frame, NOOK_VERSION);
 *     frame.depth_texture = depth;  frame.width = width;  frame.height = height;
 *     memcpy(frame.projection, projection, sizeof frame.projection);
 *     frame.radius = 0.5f;
 *     nook_nnao_render(pass, &frame);
 * The shader that lights multiplies the ambient term (not the direct light) by
 *     float ao = texelFetch(nook_ao, ivec2(gl_FragCoord.xy), 0).r;
 *
 * If the host wrote an input with image stores, it must call glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT)
 * before nook_nnao_render. On every path the result is written by a draw, so that reading it needs no
 * barrier.
 *
 * View space is OpenGL's: x right, y up, the camera looks along -z, in metres. The origin of images is their
 * lower left corner. Functions make OpenGL calls unless their comment says otherwise; nook_gl.h describes the
 * OpenGL state that they touch and what may not be active. */
#ifndef NOOK_NNAO_H
#define NOOK_NNAO_H

#include "nook_gl.h"
#include "nook_nnao_recording.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_nnao_s* nook_nnao;

/* The stage that evaluates the network; the other stages are draws in any case. Both paths give the same AO,
 * on Mesa's llvmpipe the same bits. */
enum {
  /* Compute if OpenGL has it, else fragments; fragments on OpenGL ES. */
  NOOK_NNAO_PATH_AUTOMATIC = 0,
  /* A draw, on OpenGL 3.3, OpenGL ES 3.0 and WebGL 2. */
  NOOK_NNAO_PATH_FRAGMENT = 1,
  /* A dispatch. It needs OpenGL 4.3 or OpenGL ES 3.1, glBindImageTexture, and a max_tier in nook_gl_desc
   * that allows it. OpenGL ES writes no images of one byte: AO takes four there. */
  NOOK_NNAO_PATH_COMPUTE = 2
};
typedef int32_t nook_nnao_path;

/* The sample of a multisampled depth texture whose depth, and with nook_nnao_desc.normal_samples whose
 * normal, is that of the pixel. */
enum {
  /* The median of the depths, of two the nearer one: a surface that covers most of the pixel. */
  NOOK_NNAO_SAMPLE_MEDIAN = 0,
  /* Sample 0. */
  NOOK_NNAO_SAMPLE_FIRST = 1,
  /* The nearest one. */
  NOOK_NNAO_SAMPLE_NEAREST = 2
};
typedef int32_t nook_nnao_sample;

typedef struct nook_nnao_desc {
  /* nook_nnao_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Pixels, 1 to 16384; required. Frames of any size up to this maximum allocate nothing. */
  int32_t max_width;
  int32_t max_height;
  /* The number of pixels that the network reads around each pixel: 9 (default), 16, 32, 64, 128 or 256. */
  int32_t taps;
  /* 1: AO is computed at half width and half height, and upsampled by a joint-bilateral filter. Default 0. */
  int32_t half_resolution;
  /* The number of times that a bilateral filter over 3 x 3 pixels follows: 0, 1 (default) or 2. It averages
   * the noise of the taps, and keeps edges of depth and lines in AO. The second time takes noise away that is
   * left at edges, and fine lines with it. */
  int32_t blur;
  /* > 0, default 16. Depths that depart from a surface by more than 1 / blur_sharpness radii are an edge of
   * it, which the filter does not cross. */
  float blur_sharpness;
  /* 1: every stage is timed for nook_nnao_read_timings. Default 0. */
  int32_t timers;
  /* Default NOOK_NNAO_PATH_AUTOMATIC. */
  nook_nnao_path path;
  /* The bytes of a .nook file of `nook train nnao`, of either form. NULL (default): the embedded network. */
  const void* network;
  /* The size of network in bytes. */
  size_t network_size;
  /* 1: the pass computes bent normals as well: the mean of the open directions, weighted by their cosine.
   * nook_nnao_info.glsl has functions that light with them. The pass's own texture is GL_RGBA8 then, and
   * NOOK_NNAO_WRITE writes (n + 1) / 2 of the bent normal n into red, green and blue, in view space and of
   * unit length, and AO into alpha. Not with a network of the paper's form. Default 0. */
  int32_t bent_normals;
  /* 2 to 64: the pass keeps a mean of AO over at most so many frames, which flickers less; 4 to 8 are a good
   * start, and more follow changes later. It follows surfaces by nook_nnao_frame_desc.earlier_from_view and
   * motion_texture, and begins anew where a surface was not seen before. 0 (default): each frame stands
   * alone. Not with bent_normals. */
  int32_t temporal_frames;
  /* 1 to 16: the depth textures are of GL_TEXTURE_2D_MULTISAMPLE with so many samples, which needs OpenGL 3.3
   * or OpenGL ES 3.1, or with layers of GL_TEXTURE_2D_MULTISAMPLE_ARRAY, which needs OpenGL 3.3 or OpenGL ES
   * 3.2. Motion, layer and target stay single-sampled, and normals unless normal_samples says otherwise.
   * 0 (default): 2D textures, or arrays of them. */
  int32_t depth_samples;
  /* Default NOOK_NNAO_SAMPLE_MEDIAN, whose error was measured to be the smallest (docs/nnao.md). */
  nook_nnao_sample depth_sample;
  /* 1 to 8: depth, normals, motion, layer and target are of GL_TEXTURE_2D_ARRAY with at least so many layers,
   * such as two eyes. nook_nnao_render draws them all, layer by layer with the same textures of the pass; its
   * own texture is an array of as many layers. 0 (default): 2D textures. */
  int32_t layers;
  /* The same number as depth_samples: the normal textures are multisampled as the depth textures are, and a
   * pixel has the normal of the sample whose depth it has. Any other number but 0 is refused. 0 (default):
   * normals are single-sampled. */
  int32_t normal_samples;
} nook_nnao_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_nnao_desc_init(nook_nnao_desc* desc, size_t size, uint32_t header_version);

/* Presets by cost. The cycles are those of all its stages for a pixel, as compiled for one GPU family
 * (docs/gpu_cost.md). */
enum {
  /* 9 taps at half resolution. */
  NOOK_NNAO_PRESET_FAST = 0,
  /* 9 taps; the numbers of nook_nnao_desc_init. 2.3 times the cycles of fast. */
  NOOK_NNAO_PRESET_DEFAULT = 1,
  /* 32 taps. 2.3 times the cycles of default. */
  NOOK_NNAO_PRESET_BEST = 2
};
typedef int32_t nook_nnao_preset;

/* Sets taps, half_resolution and blur of a descriptor that nook_nnao_desc_init has filled. The call makes no
 * OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_nnao_desc_set_preset(nook_nnao_desc* desc, nook_nnao_preset preset);

/* Computes the texture memory of a pass with this descriptor: 7 bytes for each pixel, or 3 at half
 * resolution, which at 3840 x 2160 is 58 MB and 25 MB. A blur of 2 at full resolution takes 2 more bytes.
 * Each of nook_nnao_desc.layers beyond the first takes the bytes of the pass's own texture, 1 or 4, and those
 * of temporal_frames. With bent normals it is 12 bytes or 7, 100 MB and 58 MB, and 4 more with a blur of 2 at
 * full resolution. temporal_frames take 12 more bytes, or 3 at half resolution. normal_samples take 4 more
 * bytes, or 1 at half resolution, and twice as many with temporal_frames. A network of the paper's form
 * takes 4 more bytes for each pixel, or 1, and its filters 62 kB. The call makes no OpenGL call. Any thread.
 * Errors: INVALID_ARGUMENT, VERSION, BAD_FILE, FILE_VERSION. */
NOOK_API nook_result nook_nnao_memory(const nook_nnao_desc* desc, uint64_t* bytes);

/* Creates textures and shaders; the caller may free the network's bytes afterwards. On failure *out is NULL
 * and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED (the size exceeds the textures of this
 * OpenGL, or this OpenGL lacks the path, multisample textures or arrays of them), BAD_FILE, FILE_VERSION, GL,
 * OUT_OF_MEMORY.
 */
NOOK_API nook_result nook_nnao_create(nook_gl gl, const nook_nnao_desc* desc, nook_nnao* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. The nook_gl may have
 * been destroyed before, but the OpenGL context of nook_gl_create must be current; after nook_gl_context_lost
 * none is needed.
 * Context thread. */
NOOK_API void nook_nnao_destroy(nook_nnao* pass);

/* The contents of a depth texture. */
enum {
  /* The depth that OpenGL wrote under `projection` and glDepthRange(0, 1): a texture of a depth format, or a
   * copy of it in the red channel of a 32-bit float texture. */
  NOOK_NNAO_DEPTH_HARDWARE = 0,
  /* -z of view space in metres, in the red channel of a float texture. */
  NOOK_NNAO_DEPTH_LINEAR = 1,
  /* A shader of the host wrote log2(1 + C (w - n)) / log2(1 + C (f - n)) to gl_FragDepth, or to the red
   * channel of a 32-bit float texture. w is -z of view space, which is clip w where projection[11] is -1. C,
   * n and f are depth_log_scale, depth_log_near and depth_log_far; values of 1 and more are sky. Only with a
   * perspective. The pass inverts it: w = n + (exp2(stored log2(1 + C (f - n))) - 1) / C. three.js has
   * C = 1 and n = 0, Cesium has C = 1 and its near plane. */
  NOOK_NNAO_DEPTH_LOGARITHMIC = 2
};
typedef int32_t nook_nnao_depth_kind;

/* The measure of the radius. */
enum {
  /* Metres, or the unit of length that projection, linear depth and sky_depth have: AO depends on their
   * ratios alone. */
  NOOK_NNAO_RADIUS_METRES = 0,
  /* A share of the viewport's height, up to 1: the radius covers the same number of pixels at each depth. The
   * edges of the filter follow it. */
  NOOK_NNAO_RADIUS_SCREEN = 1,
  /* A share of nook_nnao_frame_desc.scene_size, up to 1. */
  NOOK_NNAO_RADIUS_SCENE = 2
};
typedef int32_t nook_nnao_radius_kind;

/* The depth range of clip space. */
enum {
  /* OpenGL's default. */
  NOOK_NNAO_CLIP_NEGATIVE_ONE_TO_ONE = 0,
  /* glClipControl(..., GL_ZERO_TO_ONE). */
  NOOK_NNAO_CLIP_ZERO_TO_ONE = 1
};
typedef int32_t nook_nnao_clip;

/* The combination of the result s of the pass with a layer texture. c is the layer's red channel: AO of
 * another kind, such as that of nook_gl_scene_update, which the host draws (1 where there is none). w is its
 * green channel, a weight. */
enum {
  /* s. */
  NOOK_NNAO_LAYER_NONE = 0,
  /* min(s, c): occlusion that both contain darkens once. */
  NOOK_NNAO_LAYER_MIN = 1,
  /* min(s, c) / c: for an image that c has already darkened, so that the product is min(s, c). */
  NOOK_NNAO_LAYER_REMAINDER = 2,
  /* (1 - w) s + w c: where w is 1, only the layer counts. */
  NOOK_NNAO_LAYER_REPLACE = 3,
  /* (1 - w) s + w c, and surfaces whose w is above 0.5 hide nothing from others, for characters whose casters
   * darken the others in nook_world_render: what both know then darkens once. */
  NOOK_NNAO_LAYER_APART = 4
};
typedef int32_t nook_nnao_layer;

/* Where the result goes. */
enum {
  /* The pass's own texture: AO in red, or the bent normal and AO; see nook_nnao_info. */
  NOOK_NNAO_TARGET_OWN = 0,
  /* Level 0 of a 2D texture of the host, or of a texture array for passes with layers. */
  NOOK_NNAO_TARGET_TEXTURE = 1,
  /* The first draw buffer of a framebuffer of the host; framebuffer 0 is the window. The contents of further
   * draw buffers become undefined. Not for passes with layers. */
  NOOK_NNAO_TARGET_FRAMEBUFFER = 2
};
typedef int32_t nook_nnao_target;

/* The change that the result makes to its target. */
enum {
  /* The target becomes (ao, ao, ao, 1), or the bent normal and ao; see nook_nnao_desc.bent_normals. */
  NOOK_NNAO_WRITE = 0,
  /* The target's colour is multiplied by ao, and its alpha stays. Not with NOOK_NNAO_TARGET_OWN. */
  NOOK_NNAO_MULTIPLY = 1
};
typedef int32_t nook_nnao_blend;

/* The quantity that the pass shows, for debug views. */
enum {
  /* The result. */
  NOOK_NNAO_VIEW_AO = 0,
  /* The AO of the network for this frame, without filter, intensity, power and layer. */
  NOOK_NNAO_VIEW_RAW = 1,
  /* The AO after the filter, without intensity, power and layer. */
  NOOK_NNAO_VIEW_BLURRED = 2,
  /* The normals that the network used, as (n + 1) / 2 in red, green and blue. Not with
   * NOOK_NNAO_TARGET_OWN. */
  NOOK_NNAO_VIEW_NORMALS = 3
};
typedef int32_t nook_nnao_view;

/* One frame. Textures are 2D and single-sampled, unless nook_nnao_desc has depth_samples, normal_samples or
 * layers; level 0 with width x height texels is read. The pass reads them through its own samplers: it
 * changes none of their parameters, and their filter, wrap and compare modes do not matter. The pass queries
 * the size and format of textures and targets when a name, kind or size here differs from that of the last
 * call. If the host creates a texture anew under its old name, it must call nook_nnao_recheck. */
typedef struct nook_nnao_frame_desc {
  /* nook_nnao_frame_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Pixels; the size of every texture here, which may not exceed the maximum of the pass. Required. */
  int32_t width, height;
  /* x, y, width and height in pixels of the part that `projection` fills; all 0 (default): everything. The
   * pass reads and writes nothing outside it. */
  int32_t viewport[4];
  /* Required. */
  uint32_t depth_texture;
  /* Default NOOK_NNAO_DEPTH_HARDWARE. */
  nook_nnao_depth_kind depth_kind;
  /* Metres, for linear depth only: this depth and greater ones are sky. 0 (default): no depth is. Sky is also
   * a depth that is not finite, or is not positive in a perspective, and the far plane of hardware depth. The
   * AO of sky is exactly 1. */
  float sky_depth;
  /* 0 (default): the pass reconstructs normals from depth. */
  uint32_t normal_texture;
  /* The normal is normal_matrix * (texel * normal_scale + normal_bias), then normalised. The defaults are 1
   * and 0; normals that are stored as (n + 1) / 2 need 2 and -1. */
  float normal_scale, normal_bias;
  /* Column-major; it maps to view space. The identity by default. */
  float normal_matrix[9];
  /* Column-major, as OpenGL takes it; required. Perspective, off-centre, orthographic, reversed-depth and
   * infinite projections are all supported. */
  float projection[16];
  /* Only hardware depth uses it. Default NOOK_NNAO_CLIP_NEGATIVE_ONE_TO_ONE. */
  nook_nnao_clip clip;
  /* > 0, in metres or as radius_kind says; required. Geometry beyond this distance does not occlude. */
  float radius;
  /* Pixels: the maximum that the radius covers on the screen; near the camera the radius shrinks. 0
   * (default): a quarter of the viewport's height, and no maximum with NOOK_NNAO_RADIUS_SCREEN. */
  float max_radius_px;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power. intensity is in [0, 16] and power in (0, 16]; both
   * default to 1. */
  float intensity, power;
  /* Default NOOK_NNAO_LAYER_NONE. */
  nook_nnao_layer layer;
  /* Required unless layer is NOOK_NNAO_LAYER_NONE. */
  uint32_t layer_texture;
  /* Default NOOK_NNAO_TARGET_OWN. */
  nook_nnao_target target;
  /* The OpenGL name of the host's texture or framebuffer. Pixel (x, y) of the frame is written to its pixel
   * (x, y). sRGB formats are written and multiplied in linear light. */
  uint32_t target_name;
  /* Default NOOK_NNAO_WRITE. */
  nook_nnao_blend blend;
  /* Default NOOK_NNAO_VIEW_AO. */
  nook_nnao_view view;
  /* The fields below are for passes with temporal_frames; others do not read them. The earlier frame is the
   * last one that this pass rendered. Three rows of four: from the view space of this frame to that of the
   * earlier frame, which is the earlier view matrix times the inverse of this one. The identity by default: a
   * camera that does not move. */
  float earlier_from_view[12];
  /* Red and green times motion_scale are the pixels by which the surface moved since the earlier frame, to
   * the right and up: its position in this frame less that in the earlier one, with the camera's motion. A 2D
   * texture of width x height in floats or normalised integers. 0 (default): nothing but the camera moves. */
  uint32_t motion_texture;
  /* 1, 1 by default: motion in pixels. Motion in texture coordinates needs width, height. */
  float motion_scale[2];
  /* 1: a cut: nothing of earlier frames is used. Changes of the viewport's size and of the kind of projection
   * are cuts as well. Default 0. */
  int32_t reset;
  /* Default NOOK_NNAO_RADIUS_METRES. */
  nook_nnao_radius_kind radius_kind;
  /* Metres, > 0: a length of the scene, such as the diagonal of its bounding box. NOOK_NNAO_RADIUS_SCENE
   * needs it; nothing else reads it. */
  float scene_size;
  /* Of logarithmic depth, see NOOK_NNAO_DEPTH_LOGARITHMIC. C in 1 / metres, > 0, default 1; n in metres, 0 or
   * more, default 0; f in metres, > n, required. */
  float depth_log_scale, depth_log_near, depth_log_far;
  /* For passes with layers; others do not read them. 16, 9 and 12 numbers for each layer, in place of
   * projection, normal_matrix and earlier_from_view. NULL (default): the frame's own matrix for all layers.
   */
  const float* layer_projections;
  const float* layer_normal_matrices;
  const float* layer_earlier_from_view;
} nook_nnao_frame_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_nnao_frame_desc_init(nook_nnao_frame_desc* desc, size_t size,
                                               uint32_t header_version);

/* Draws the AO of a frame. The call allocates nothing, reads nothing back and never waits for the GPU. On
 * failure it leaves no OpenGL error, changes no state and draws nothing.
 * Context thread. Errors: INVALID_ARGUMENT (the message names the field, its value and what is needed: a size
 * exceeds the maximum or is not that of a texture, a format is of another kind, an input is the target, a
 * matrix is not finite, is singular or is no projection, or the radius is not above 0), VERSION, GL (the
 * OpenGL context was lost). */
NOOK_API nook_result nook_nnao_render(nook_nnao pass, const nook_nnao_frame_desc* frame);

/* Makes the next nook_nnao_render query every texture again. The call makes no OpenGL call.
 * Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_recheck(nook_nnao pass);

typedef struct nook_nnao_info {
  /* sizeof(nook_nnao_info); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of the pass's own texture, an array for passes with layers: GL_R8, or GL_RGBA8 with bent
   * normals, max_width x max_height, the AO of pixel (x, y) in texel (x, y), in red or in alpha. Nook owns
   * it: the host reads it, and never writes or deletes it. AO is 1 everywhere before the first frame. Later
   * frames write only their viewport; frames with another target leave it undefined. */
  uint32_t texture;
  /* The memory of all textures of the pass. */
  uint64_t texture_bytes;
  int32_t taps;
  /* 1: the network has the horizon form; 0: it has the paper's. */
  int32_t horizon_form;
  /* The path in use: NOOK_NNAO_PATH_FRAGMENT or NOOK_NNAO_PATH_COMPUTE. */
  nook_nnao_path path;
  /* 1: the texture has bent normals. */
  int32_t bent_normals;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions, for the host's shader that lights.
   * Directions are unit vectors in one space, roughness is perceptual (the GGX width is its square):
   *     vec3 nook_nnao_bent_normal(vec4 texel)               view space, of a texel with bent normals
   *     float nook_nnao_cone_cosine(float ao)                cosine of the open cone's half angle
   *     vec3 nook_nnao_multi_bounce(float ao, vec3 albedo)   AO with light that the surroundings reflect
   *     float nook_nnao_specular_occlusion(vec3 bent_normal, float ao, vec3 normal, vec3 to_viewer,
   *                                        float roughness)
   * The irradiance of a probe is looked up along the bent normal and multiplied by AO; what a glossy surface
   * reflects is multiplied by the specular occlusion. The text is the same for every pass and valid as long
   * as the library is loaded. */
  const char* glsl;
} nook_nnao_info;

/* Describes a pass. The call makes no OpenGL call.
 * Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_describe(nook_nnao pass, nook_nnao_info* info);

/* The time that the GPU took for each stage of the newest finished frame, in milliseconds; with
 * nook_nnao_desc.layers, for the last layer. */
typedef struct nook_nnao_timings {
  /* sizeof(nook_nnao_timings); the caller sets it. */
  uint32_t struct_size;
  /* 0: no frame is finished yet, or the pass has no timers; the other members are 0 then. */
  int32_t valid;
  /* Linear depth, and the normals of the paper's form. */
  float normals;
  /* The network, edges, reading or reconstructing normals, and the mean over frames. */
  float occlusion;
  /* The filter at half resolution; at full resolution it is a part of resolve. */
  float blur;
  /* Filter or upsample, layer and target. */
  float resolve;
  float total;
} nook_nnao_timings;

/* Gives the newest times; the call never waits.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_nnao_read_timings(nook_nnao pass, nook_nnao_timings* timings);

/* Records a frame: draws its AO into the pass's own texture, and reads that back with the depth, the normals
 * and the layer of the frame. Blend, target and target_name have no effect: no target of the host is written.
 * NOOK_NNAO_VIEW_NORMALS records the result. Logarithmic depth is recorded as the linear depth
 * that follows from it, and a share of the scene as metres. note is a remark for whoever opens the file, or
 * NULL. The call may stand before nook_nnao_render of the same frame or after it. It WAITS FOR THE GPU,
 * allocates, and makes a program: it is meant for reports of errors and for measurements. It is not for
 * passes with depth_samples or layers. On failure *out is NULL. Context thread. Errors: INVALID_ARGUMENT (as
 * nook_nnao_render; also, the note is longer than 1000 bytes or has control characters), VERSION, GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_record(nook_nnao pass, const nook_nnao_frame_desc* frame, const char* note,
                                      nook_nnao_recording* out);

#ifdef __cplusplus
}
#endif
#endif
