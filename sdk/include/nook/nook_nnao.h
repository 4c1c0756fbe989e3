/* Screen-space ambient occlusion by a small neural network. The input is a depth buffer, and normals if you
 * have them; the output is AO in a texture, or multiplied into an image of yours. The only required setting
 * is the radius. The method is D. Holden, J. Saito and T. Komura, Neural Network Ambient Occlusion, 2016. The
 * embedded network reads pixels along directions on the screen (the horizon form). You can also load a
 * network of the paper's form, which reads a grid of 31 x 31 pixels. Both are trained on the cosine-weighted
 * visibility of the hemisphere around the normal, up to the radius. Each frame, between drawing depth and
 * lighting:
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
 * unless their comment says otherwise; nook_gl.h describes the state that they touch. */
#ifndef NOOK_NNAO_H
#define NOOK_NNAO_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Presets. "Cycles" are GPU cycles per pixel for all stages, on one GPU family (docs/gpu_cost.md). */
enum {
  /* 9 taps, one filter. */
  NOOK_NNAO_PRESET_DEFAULT = 0,
  /* 9 taps at half resolution, one filter. 0.44 times the cycles of DEFAULT. */
  NOOK_NNAO_PRESET_FAST = 1,
  /* 32 taps, one filter. 2.3 times the cycles of DEFAULT. */
  NOOK_NNAO_PRESET_BEST = 2
};
typedef int32_t nook_nnao_preset;

typedef struct nook_nnao_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_nnao_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* Pixels, 1 to 16384; required. Frames of any size up to this allocate nothing. */
  int32_t max_width, max_height;
  /* Sets `taps`, `half_resolution` and `blur` if they are -1. Default NOOK_NNAO_PRESET_DEFAULT. */
  nook_nnao_preset preset;
  /* Pixels that the network reads around each pixel: 9, 16, 32, 64, 128 or 256. Default -1: the preset's. */
  int32_t taps;
  /* 1: AO is computed at half width and height, and upsampled joint-bilaterally. Default -1: the preset's. */
  int32_t half_resolution;
  /* The number of bilateral filters over 5 x 5 pixels: 0, 1 or 2. A filter averages out the noise of the
   * taps. The second filter removes noise at edges, but also fine lines. Default -1: the preset's. */
  int32_t blur;
  /* > 0, default 16. The filter does not mix surfaces whose depths differ by more than 1 / blur_sharpness
   * radii. */
  float blur_sharpness;
  /* 1: the pass also computes bent normals, the cosine-weighted mean of the open directions;
   * nook_nnao_info.glsl has functions for lighting with them. The pass's own texture is GL_RGBA8 then, and
   * NOOK_BLEND_WRITE writes (n + 1) / 2 of the unit bent normal n in view space, and AO into alpha. Not with
   * a network of the paper's form. Default 0. */
  int32_t bent_normals;
  /* The bytes of a .nook file of `nook train nnao`, of either form. NULL (default): the embedded network. */
  const void* network;
  /* The size of network in bytes. */
  size_t network_size;
  /* 2 to 64: the pass averages AO over at most this many frames, so it flickers less. Start with 4 to 8; with
   * more frames, AO reacts later to changes. The pass follows surfaces by nook_gl_frame_desc.view and
   * motion_vectors. 0 (default): no averaging. Not with bent_normals. */
  int32_t max_history_frames;
  /* 1 to 16: depth is GL_TEXTURE_2D_MULTISAMPLE with this many samples, which needs OpenGL 3.3 or OpenGL ES
   * 3.1, or with views GL_TEXTURE_2D_MULTISAMPLE_ARRAY, which needs OpenGL 3.3 or OpenGL ES 3.2. A pixel uses
   * the median of its depths, or the nearer one of two. Motion vectors, G-buffer AO and target stay
   * single-sampled. 0 (default): 2D textures, or arrays of them. */
  int32_t depth_samples;
  /* 1 to 8: the pass draws this many views in one call, such as two eyes. Depth, normals, motion vectors,
   * G-buffer AO and target are then GL_TEXTURE_2D_ARRAY with at least this many layers, and so is the pass's
   * own texture. 0 (default): 2D textures. */
  int32_t views;
  /* 0 (default): normals are single-sampled. The value of depth_samples: normals are multisampled, and each
   * pixel uses the normal of the same sample that its depth comes from. */
  int32_t normal_samples;
} nook_nnao_desc;
static inline nook_result nook_nnao_desc_init(nook_nnao_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a pass. You may free the network's bytes afterwards. On failure *out is NULL and no OpenGL object
 * is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the size exceeds the textures of this OpenGL, or it
 * lacks multisample textures or arrays of them), BAD_FILE, FILE_VERSION, GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_nnao_create(nook_gl gl, const nook_nnao_desc* desc, nook_nnao* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. You may destroy the
 * nook_gl before, but its OpenGL context must be current; after nook_gl_context_lost none is needed. Context
 * thread. */
NOOK_API void nook_nnao_destroy(nook_nnao* pass);

/* How the radius is measured. */
enum {
  /* Metres, or any unit, if `projection`, linear depth and sky_depth use it too; only the ratios matter. */
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
  /* > 0, in metres or as radius_kind says; required. Geometry beyond this distance does not occlude. */
  float radius;
  /* Default NOOK_NNAO_RADIUS_METRES. */
  nook_nnao_radius_kind radius_kind;
  /* For NOOK_NNAO_RADIUS_SCENE: a length of the scene, metres, > 0, such as the diagonal of its bounds. */
  float scene_size;
  /* The maximum radius in pixels; near the camera, the radius is reduced to it. 0 (default): a quarter of the
   * viewport's height, or no maximum with NOOK_NNAO_RADIUS_SCREEN. */
  float max_radius_px;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power; in [0, 16] and (0, 16], both default to 1. */
  float intensity, power;
  /* For passes with max_history_frames: a 2D texture of width x height in floats or normalised integers. Red
   * and green, times motion_vector_scale, are the motion of the surface to the right and up since the last
   * frame, in pixels, including the camera's motion. 0 (default): only the camera moves. */
  uint32_t motion_vectors;
  /* 1, 1 by default: motion in pixels. For motion in texture coordinates, set width, height. */
  float motion_vector_scale[2];
  /* Set 1 at a cut to ignore earlier frames. A new viewport size or kind of projection does this too. */
  int32_t reset;
  /* The minimum radius in pixels, default 12; 0: no minimum. Far away, the radius grows to this minimum and
   * the AO becomes weaker in return, which gives smooth AO instead of flicker. */
  float min_radius_px;
  /* Metres from the camera: AO fades from fade_begin on, and is 1 from fade_end on. 0 (default): no
   * fading. */
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
  /* The pass's own texture, which Nook owns, an array for passes with views. It is GL_R8, or GL_RGBA8 with
   * bent normals, max_width x max_height. Texel (x, y) holds the AO of pixel (x, y) in red, or in alpha with
   * bent normals. AO is 1 everywhere before the first frame. Frames write only their viewport; after a frame
   * with another target, this texture is undefined. */
  uint32_t texture;
  /* The memory of all textures of the pass. */
  uint64_t texture_bytes;
  /* The settings in use, with the preset's value where the descriptor had -1. */
  int32_t taps, half_resolution, blur;
  /* 1: the network has the horizon form; 0: the paper's form. */
  int32_t horizon_form;
  /* 1: a compute shader evaluates the network; 0: a draw does. */
  int32_t compute;
  /* 1: the texture has bent normals. */
  int32_t bent_normals;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions, for your lighting. Directions are unit
   * vectors in one space, roughness is perceptual (the GGX width is its square):
   *     vec3 nook_nnao_bent_normal(vec4 texel)               view space, of a texel with bent normals
   *     float nook_nnao_cone_cosine(float ao)                cosine of the open cone's half angle
   *     vec3 nook_nnao_multi_bounce(float ao, vec3 albedo)   AO with light that the surroundings reflect
   *     float nook_nnao_specular_occlusion(vec3 bent_normal, float ao, vec3 normal, vec3 to_viewer,
   *                                        float roughness)
   * Look up the irradiance of a probe along the bent normal and multiply it by AO. Multiply glossy
   * reflections by the specular occlusion. The text is the same for every pass and valid while the library is
   * loaded. */
  const char* glsl;
} nook_nnao_info;

/* Describes a pass, without an OpenGL call. Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_nnao_describe(nook_nnao pass, nook_nnao_info* info);

#ifdef __cplusplus
}
#endif
#endif
