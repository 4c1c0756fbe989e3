/* Screen-space ambient occlusion by a small neural network. The input is a depth buffer, and normals if you
 * have them; the output is AO, in a texture or multiplied into your own image. The only required setting is
 * the radius. The method is D. Holden, J. Saito and T. Komura, Neural Network Ambient Occlusion, 2016. The
 * embedded network reads pixels along directions on the screen (the horizon form). You can also load a
 * network of the paper's form, which reads a grid of 31 x 31 pixels. Both are trained on the cosine-weighted
 * visibility of the hemisphere around the normal, up to the radius. Each frame, after you have drawn depth
 * and before lighting, call:
 *     nook_gl_frame_desc frame;
 *     nook_nnao_frame_desc nnao_frame;
 *     nook_gl_frame_desc_init(&frame);
 *     nook_nnao_frame_desc_init(&nnao_frame);
 *     frame.depth_texture = depth;  frame.width = width;  frame.height = height;
 *     memcpy(frame.projection, projection, sizeof frame.projection);
 *     nnao_frame.radius = 0.5f;
 *     nook_nnao_render(nnao, &frame, &nnao_frame);
 * Your shader multiplies the ambient term (not the direct light) by
 *     float ao = texelFetch(nook_ao, ivec2(gl_FragCoord.xy), 0).r;
 * If you wrote an input with image stores, call glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT) before
 * nook_nnao_render. Reading the result needs no barrier. View space is OpenGL's: x right, y up, the camera
 * looks along -z, in metres. The origin of images is their lower left corner. Functions make OpenGL calls
 * unless their comment says otherwise; nook_gl_state_mode says what happens to the OpenGL state. */
#ifndef NOOK_NNAO_H
#define NOOK_NNAO_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The presets. "Cycles" are the GPU cycles per pixel of all stages on one GPU family (docs/gpu_cost.md). */
enum {
  /* 9 taps, one filter. */
  NOOK_NNAO_PRESET_DEFAULT = 0,
  /* 9 taps at half resolution, one filter. It takes 0.44 times the cycles of DEFAULT. */
  NOOK_NNAO_PRESET_FAST = 1,
  /* 32 taps, one filter. It takes 2.3 times the cycles of DEFAULT. */
  NOOK_NNAO_PRESET_BEST = 2
};
typedef int32_t nook_nnao_preset;

typedef struct nook_nnao_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_nnao_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* The maximum size of a frame in pixels, 1 to 16384; required. Frames up to this size allocate nothing. */
  int32_t max_width, max_height;
  /* Sets `taps`, `half_resolution` and `blur` if they are -1. Default NOOK_NNAO_PRESET_DEFAULT. */
  nook_nnao_preset preset;
  /* The number of pixels that the network reads around each pixel: 9, 16, 32, 64, 128 or 256. Default -1: the
   * preset's value. */
  int32_t taps;
  /* 1: AO has half width and height, and a joint-bilateral filter upsamples it. Default -1: the preset's. */
  int32_t half_resolution;
  /* The number of bilateral filters over 7 x 7 pixels: 0, 1 or 2. A filter averages out the noise of the
   * taps. The second filter removes noise at edges, but also fine lines. Default -1: the preset's. */
  int32_t blur;
  /* > 0, default 16. Surfaces are not mixed if their depths differ by more than radius / blur_sharpness. */
  float blur_sharpness;
  /* 1: the pass also computes bent normals, the cosine-weighted mean of the open directions;
   * nook_nnao_info.glsl has functions for lighting with them. The pass's own texture is then GL_RGBA8.
   * NOOK_BLEND_WRITE writes (n + 1) / 2, where n is the unit bent normal in view space, and AO into alpha.
   * Not with a network of the paper's form. Default 0. */
  int32_t bent_normals;
  /* The bytes of a .nook file from `nook train nnao`, in either form. Default NULL: the embedded network. */
  const void* network;
  size_t network_size;
  /* 2 to 64: the pass averages AO over at most this many frames, so it flickers less. Start with 4 to 8; with
   * more frames, AO reacts more slowly to changes. The pass reprojects the last frame by
   * nook_gl_frame_desc.view and motion_vectors. 0 (default): no averaging. Not with bent_normals. */
  int32_t max_history_frames;
  /* 1 to 16: the depth texture is GL_TEXTURE_2D_MULTISAMPLE with this many samples (OpenGL 3.3 or OpenGL ES
   * 3.1). For passes with views, it is GL_TEXTURE_2D_MULTISAMPLE_ARRAY (OpenGL 3.3 or OpenGL ES 3.2). Each
   * pixel uses the median of its depths, or the nearer one of two depths. Motion vectors, G-buffer AO and
   * target stay single-sampled. 0 (default): 2D textures, or arrays of them. */
  int32_t depth_samples;
  /* 1 to 8: the pass draws this many views in one call, such as two eyes. Depth, normals, motion vectors,
   * G-buffer AO, target and the pass's own texture are then GL_TEXTURE_2D_ARRAY with at least this many
   * layers. 0 (default): 2D textures. */
  int32_t views;
  /* 0 (default): normals are single-sampled. If equal to depth_samples, normals are multisampled, and each
   * pixel uses the normal of the same sample that its depth comes from. */
  int32_t normal_samples;
} nook_nnao_desc;
static inline nook_result nook_nnao_desc_init(nook_nnao_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a pass. You may free the network's bytes afterwards. On failure *out is NULL and no OpenGL object
 * is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the size exceeds the largest texture of this OpenGL,
 * or this OpenGL lacks multisample textures or arrays of them), BAD_FILE, FILE_VERSION, GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_create(nook_gl gl, const nook_nnao_desc* desc, nook_nnao* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. You may destroy the
 * nook_gl first. Its OpenGL context must be current unless it was lost. Context thread. */
NOOK_API void nook_nnao_destroy(nook_nnao* pass);

/* How the radius is measured. */
enum {
  /* In metres. Any other unit works too, if `projection`, linear depth and sky_depth use the same unit. */
  NOOK_NNAO_RADIUS_METRES = 0,
  /* A share of the viewport's height, up to 1: the radius covers the same number of pixels at each depth. */
  NOOK_NNAO_RADIUS_SCREEN = 1,
  /* A share of nook_nnao_frame_desc.scene_size, up to 1. */
  NOOK_NNAO_RADIUS_SCENE = 2
};
typedef int32_t nook_nnao_radius_kind;

/* The settings of the screen pass for one frame. The images and the camera are in nook_gl_frame_desc. */
typedef struct nook_nnao_frame_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_nnao_frame_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* Required, > 0, measured as radius_kind says. Geometry beyond this distance does not occlude. */
  float radius;
  /* Default NOOK_NNAO_RADIUS_METRES. */
  nook_nnao_radius_kind radius_kind;
  /* For NOOK_NNAO_RADIUS_SCENE: a length of the scene in metres, > 0, such as its diagonal. */
  float scene_size;
  /* The maximum radius in pixels; near the camera, a larger radius is reduced to this maximum. 0 (default): a
   * quarter of the viewport's height, or no maximum with NOOK_NNAO_RADIUS_SCREEN. */
  float max_radius_px;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power. `intensity` is in [0, 16] and `power` in (0, 16];
   * both default to 1. */
  float intensity, power;
  /* For passes with max_history_frames: a 2D texture of width x height in floats or normalised integers. Red
   * and green, times motion_vector_scale, are the motion of the surface to the right and up since the last
   * frame, in pixels, including the camera's motion. 0 (default): only the camera moves. */
  uint32_t motion_vectors;
  /* Default (1, 1), for motion in pixels. For motion in texture coordinates, set (width, height). */
  float motion_vector_scale[2];
  /* Set 1 at a cut, so that the pass ignores earlier frames. The pass also ignores earlier frames if the size
   * of the viewport or the kind of projection changes. */
  int32_t reset;
  /* The minimum radius in pixels, default 12; 0: no minimum. Far away, the pass enlarges the radius to this
   * minimum and weakens the AO in return, which gives smooth AO instead of flicker. */
  float min_radius_px;
  /* Distances from the camera in metres. From fade_begin to fade_end, AO fades to 1. Default 0: no fade. */
  float fade_begin, fade_end;
} nook_nnao_frame_desc;
static inline nook_result nook_nnao_frame_desc_init(nook_nnao_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* Draws the AO of a frame. The call does not allocate, read back or wait for the GPU. On failure it leaves no
 * OpenGL error, changes no state and draws nothing. Context thread. Errors: INVALID_ARGUMENT (the message
 * names the field, its value and what is needed), GL (the OpenGL context was lost). */
NOOK_API nook_result nook_nnao_render(nook_nnao pass, const nook_gl_frame_desc* frame,
                                      const nook_nnao_frame_desc* desc);

typedef struct nook_nnao_info {
  uint32_t struct_size;
  /* The pass's own texture, which Nook owns; for passes with views, a texture array. Its size is max_width x
   * max_height, and its format is GL_R8, or GL_RGBA8 with bent normals. Texel (x, y) holds the AO of pixel
   * (x, y) in red, or in alpha with bent normals. AO is 1 everywhere before the first frame. A frame writes
   * only its viewport. After a frame with another target, the contents of this texture are undefined. */
  uint32_t texture;
  /* The bytes of all textures of the pass. */
  uint64_t texture_bytes;
  /* The settings in use, with the preset's value where the descriptor had -1. */
  int32_t taps, half_resolution, blur;
  /* 1: the network has the horizon form; 0: the paper's form. */
  int32_t horizon_form;
  /* 1: a compute shader evaluates the network; 0: a fragment shader evaluates it. */
  int32_t compute;
  int32_t bent_normals;
  /* GLSL 3.30 and GLSL ES 3.00 text for your lighting. It has no #version and precision lines. Directions are
   * unit vectors in one space, roughness is perceptual (the GGX width is its square):
   *     vec3 nook_nnao_bent_normal(vec4 texel)               view space, of a texel with bent normals
   *     float nook_nnao_cone_cosine(float ao)                cosine of the open cone's half angle
   *     vec3 nook_nnao_multi_bounce(float ao, vec3 albedo)   AO that includes light from nearby surfaces
   *     float nook_nnao_specular_occlusion(vec3 bent_normal, float ao, vec3 normal, vec3 to_viewer,
   *                                        float roughness)
   * Look up the irradiance of a probe along the bent normal and multiply it by AO. Multiply glossy
   * reflections by the specular occlusion. The text is the same for every pass and stays valid while the
   * library is loaded. */
  const char* glsl;
} nook_nnao_info;

/* Describes a pass, without an OpenGL call. Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_describe(nook_nnao pass, nook_nnao_info* info);

#ifdef __cplusplus
}
#endif
#endif
