/* Characters darken the world around them: AO, and the soft shadow of one light, computed from capsules.
 * `nook bake character` fits at most 64 capsules, each rigidly attached to one bone, to ray-traced AO, and
 * stores them in the model's file. The capsules of a scene's instances are casters. The scene's free
 * occluders are casters too, as spheres, and so are the capsules that you pass in nook_world_frame_desc. For
 * AO, Nook computes in closed form which share of a point's cosine-weighted hemisphere a capsule covers. The
 * share is exact if the capsule is above the horizon. The radii are multiplied by a factor that the bake
 * fits. The open shares of several capsules are multiplied together. For the shadow of one light, Nook
 * divides the light's cone into NOOK_WORLD_CONE_PARTS equal parts, and multiplies the open shares of the
 * capsules in each part. The light's open share is the mean over the parts. If you pass lobes, you get a
 * shadow with direction and colour. A capsule that covers a share f of the hemisphere takes away f * rho of
 * the light. For each channel, rho is the mean radiance behind the capsule divided by the hemisphere's mean
 * radiance. So a capsule in front of a bright window darkens more than a capsule in front of a wall. Under
 * constant light the result is AO. The pass uses SH bands 0 to 2 for fewer than 24 lobes, and bands 0 to 4
 * from 24 lobes on. nook_world_sample in experimental/nook_world_sample.h computes the same values on the
 * CPU. */
#ifndef NOOK_WORLD_H
#define NOOK_WORLD_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The pass ----
 *
 * After you have drawn depth, one call darkens the whole screen by the capsules of a scene, including
 * capsules outside the screen. Pass the scene, and the same frame as to the screen pass (nook_nnao.h). The
 * pass runs on every tier and uses the state_mode of nook_gl_desc. To combine it with the screen pass, draw
 * the AO of characters into the red channel of the G-buffer AO, and 1 into its green channel. The texture of
 * the world pass then holds the complete AO (for ways without a mask, see docs/guide/world.md):
 *     frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;  frame.gbuffer_ao_texture = characters;
 *     nook_nnao_render(nnao, &frame, &nnao_frame);
 *     world_frame.ao_texture = nnao_info.texture;
 *     nook_world_render(world, &frame, &world_frame);
 * To light a surface by probes and one lamp or sun, set nook_world_desc.coloured, lobes and light_axis:
 *     vec4 open = texelFetch(world_texture, pixel, 0);
 *     colour = albedo / pi * (irradiance_of_lobes * open.rgb + irradiance_of_lamp * open.a); */

typedef struct nook_world_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The maximum size of a frame in pixels, 1 to 16384. Required. */
  int32_t max_width, max_height;
  /* The initial capacity for capsules and bodies, 1 to 1,048,576, default 4096. It grows if needed. */
  uint32_t capsules;
  /* 1: AO is computed at half width and height, and upsampled by a joint-bilateral filter. Default 0. */
  int32_t half_resolution;
  /* 1: the pass also computes light, into a GL_RGBA8 texture. Red, green and blue hold the open share of the
   * light of nook_world_frame_desc.lobes; alpha holds the open share of the cone of light_axis. Default 0. */
  int32_t coloured;
} nook_world_desc;
static inline nook_result nook_world_desc_init(nook_world_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates textures and shaders. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the size or the capacity exceeds the largest texture
 * of this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_world_create(nook_gl gl, const nook_world_desc* desc, nook_world* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. You may destroy the
 * nook_gl first. Its OpenGL context must be current unless it was lost. Context thread. */
NOOK_API void nook_world_destroy(nook_world* pass);

/* How the AO w of the capsules is combined with AO s of another kind. */
enum {
  /* s * w. Use it if s does not contain occlusion by the capsules, for example if s comes from
   * nook_nnao_render with NOOK_GBUFFER_AO_EXCLUDE. */
  NOOK_WORLD_COMBINE_MULTIPLY = 0,
  /* min(s, w). Use it if s contains occlusion by the capsules too. */
  NOOK_WORLD_COMBINE_MIN = 1
};
typedef int32_t nook_world_combine;

typedef struct nook_world_frame_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_world_frame_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* The scene whose instances and occluders are casters. NULL (default): only `capsules` are casters. */
  nook_scene scene;
  /* Capsules besides the scene's, in world space; default none. */
  const nook_capsule* capsules;
  uint32_t capsule_count;
  /* A difference of AO, 0 to 1, default 1/1024. A body is ignored where it lowers AO by less than this. 0: no
   * body is ignored. */
  float cutoff_error;
  /* A difference of AO, 0 to 1, default 1/256. At a distance, one capsule replaces a limb, or farther away a
   * whole body, if that changes AO by no more than about this value (root mean square). 0: no replacement. */
  float level_error;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power. `intensity` is in [0, 16] and `power` in (0, 16];
   * both default to 1. */
  float intensity, power;
  /* Set this texture to combine the result with AO of another kind, such as from nook_nnao_render for the
   * same frame. The AO must be in the red channel of a 2D texture of the frame's size, in floats or
   * normalised integers. Default 0: none. */
  uint32_t ao_texture;
  /* Default NOOK_WORLD_COMBINE_MULTIPLY. */
  nook_world_combine combine;
  /* The light whose open share a coloured pass computes by channel: at most NOOK_PROBE_MAX_FUNCTIONS lobes in
   * world space. `intensity`, `power`, G-buffer AO and `combine` apply to each channel as they do to AO.
   * Without lobes (default), all three channels are AO. */
  const nook_lobe* lobes;
  uint32_t lobe_count;
  /* The light whose open share a coloured pass writes to alpha. Set the unit vector towards the light in
   * world space, and the full angle of its cone in degrees, above 0 and below 179. Alpha is 1 where G-buffer
   * AO replaces the result; `intensity`, `power` and `combine` have no effect on it. Default 0: no light. */
  float light_axis[3];
  float light_degrees;
  /* A capsule farther than this from a point does not shadow this point. Default 0: 30 metres. */
  float light_reach;
} nook_world_frame_desc;
static inline nook_result nook_world_frame_desc_init(nook_world_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* Draws the AO of a frame. The AO of sky is exactly 1, or the value of ao_texture. With
 * NOOK_GBUFFER_AO_REPLACE or _EXCLUDE, the frame's gbuffer_ao_texture is a mask: where the mask's green
 * channel is 1, such as on characters, the result is the mask's red channel. The call never reads back or
 * waits for the GPU, and allocates only if the number of capsules exceeds the capacity. On failure it leaves
 * no OpenGL error, changes no state and draws nothing.
 * Context thread, while no other call changes the scene. Errors: INVALID_ARGUMENT (the message names the
 * field, its value and what is needed), OUT_OF_MEMORY, GL (the OpenGL context was lost). */
NOOK_API nook_result nook_world_render(nook_world pass, const nook_gl_frame_desc* frame,
                                       const nook_world_frame_desc* desc);

typedef struct nook_world_info {
  uint32_t struct_size;
  /* The pass's own texture, max_width x max_height, which Nook owns: GL_R8, or GL_RGBA8 for a coloured pass.
   * The texture is 1 everywhere before the first frame. */
  uint32_t texture;
  /* For your shaders: a table of the capsules that may darken the last frame. Bind it to caster_target (a
   * texture buffer, or a 2D texture on OpenGL ES). It holds group_count bodies and caster_count capsules. */
  uint32_t caster_texture, caster_target;
  int32_t group_count, caster_count;
  /* The bytes of the pass's textures and table. */
  uint64_t texture_bytes;
  /* GLSL to put after the #version line: float nook_world_open(vec3 point, vec3 normal) returns AO; arguments
   * are in view space. Set the uniforms nook_world_casters (sampler) and nook_world_groups (int). */
  const char* glsl;
} nook_world_info;

/* Describes a pass, without an OpenGL call. Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_world_describe(nook_world pass, nook_world_info* info);

#ifdef __cplusplus
}
#endif
#endif
