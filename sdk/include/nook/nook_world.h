/* Characters darken the world around them: AO, and the soft shadow of one light, computed from capsules.
 * `nook bake character` fits at most 64 capsules, each rigidly attached to one bone, to ray-traced AO, and
 * stores them in the model's file. The capsules of a scene's instances are casters. The scene's free
 * occluders are casters too, as spheres, and so are the capsules that you pass in nook_world_frame_desc. AO:
 * the share of a point's cosine-weighted hemisphere that a capsule covers is computed in closed form; it is
 * exact if the capsule is above the horizon. The bake fits a scale for the radii. The open shares of several
 * capsules are multiplied together. Light: the light's cone of directions is divided into
 * NOOK_WORLD_CONE_PARTS equal parts. In each part, the open shares of the capsules are multiplied; the
 * light's open share is the mean over the parts. Light by channel: with lobes you get a shadow with direction
 * and colour. A capsule that covers a share f of the hemisphere takes away f * rho of the light. For each
 * channel, rho is the mean radiance behind the capsule divided by the hemisphere's mean radiance. So a
 * capsule in front of a bright window darkens more than one in front of a wall. Under constant light the
 * result is AO. The pass uses SH bands 0 to 2 for fewer than 24 lobes, and bands 0 to 4 from 24 lobes on.
 * nook_world_sample in experimental/nook_world_sample.h computes the same values at points on the CPU. */
#ifndef NOOK_WORLD_H
#define NOOK_WORLD_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The pass ----
 *
 * After you have drawn depth, one call darkens the whole screen by the capsules of a scene, including
 * capsules outside the screen. Pass the same frame as to the screen pass (nook_nnao.h), and the scene. The
 * pass follows the state_mode of nook_gl_desc, on every tier. To combine it with the screen pass, draw the AO
 * of characters into red of the G-buffer AO, and 1 into green. The texture of the world pass then holds the
 * complete AO (docs/guide/world.md has recipes without a mask):
 *     frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;  frame.gbuffer_ao_texture = characters;
 *     nook_nnao_render(nnao, &frame, &nnao_frame);
 *     world_frame.ao_texture = nnao_info.texture;
 *     nook_world_render(world, &frame, &world_frame);
 * Under probes and one lamp or sun, with nook_world_desc.coloured, world_frame.lobes and light_axis:
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
   * light of nook_world_frame_desc.lobes; alpha holds the open share of its light cone (light_axis). Default
   * 0. */
  int32_t coloured;
} nook_world_desc;
static inline nook_result nook_world_desc_init(nook_world_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates textures and shaders. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the size or the capacity exceeds the textures of
 * this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_world_create(nook_gl gl, const nook_world_desc* desc, nook_world* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. You may destroy the
 * nook_gl before, but its OpenGL context must be current; after nook_gl_context_lost none is needed. Context
 * thread. */
NOOK_API void nook_world_destroy(nook_world* pass);

/* How the AO w of the capsules is combined with AO s of another kind. */
enum {
  /* s * w, if s lacks occlusion by the capsules, as from nook_nnao_render with NOOK_GBUFFER_AO_EXCLUDE. */
  NOOK_WORLD_COMBINE_MULTIPLY = 0,
  /* min(s, w), if s contains occlusion by the capsules too. */
  NOOK_WORLD_COMBINE_MIN = 1
};
typedef int32_t nook_world_combine;

typedef struct nook_world_frame_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_world_frame_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* The instances of this scene, in their poses, and its occluders are casters. NULL (default): only
   * `capsules` are casters. */
  nook_scene scene;
  /* Capsules besides the scene's, in world space; default none. */
  const nook_capsule* capsules;
  uint32_t capsule_count;
  /* AO, 0 to 1, default 1/1024. A body is ignored where it would darken by less than this. 0: never. */
  float cutoff_error;
  /* AO, 0 to 1, default 1/256. At a distance, one capsule replaces a limb, and farther away a whole body,
   * where this changes AO by about this value (root mean square). 0: no replacement. */
  float level_error;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power; in [0, 16] and (0, 16], both default to 1. */
  float intensity, power;
  /* Set this to combine the result with AO of another kind, such as from nook_nnao_render for the same frame.
   * The AO must be in red of a 2D texture of the frame's size, in floats or normalised integers. Default 0:
   * none. */
  uint32_t ao_texture;
  /* Default NOOK_WORLD_COMBINE_MULTIPLY. */
  nook_world_combine combine;
  /* The light whose open share a coloured pass computes by channel: at most NOOK_PROBE_MAX_FUNCTIONS lobes in
   * world space. `intensity`, `power`, G-buffer AO and `combine` apply to each channel as to AO. Default
   * none: all three channels are AO. */
  const nook_lobe* lobes;
  uint32_t lobe_count;
  /* The light whose open share a coloured pass writes to alpha. Set the unit vector towards it in world
   * space, and the full angle of its cone in degrees, above 0 and below 179. Alpha is 1 where G-buffer AO
   * replaces the result; `intensity`, `power` and `combine` do not change it. Default 0 degrees: no light. */
  float light_axis[3];
  float light_degrees;
  /* Capsules farther than this from a point do not shadow it from the light. 0 (default): 30 metres. */
  float light_reach;
} nook_world_frame_desc;
static inline nook_result nook_world_frame_desc_init(nook_world_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* Draws the AO of a frame. The AO of sky is exactly 1, or the value of ao_texture. With
 * NOOK_GBUFFER_AO_REPLACE or _EXCLUDE, the frame's gbuffer_ao_texture is a mask: where its green channel is
 * 1, such as on characters, its red channel is the result. The call never reads back or waits for the GPU,
 * and allocates only if the number of capsules exceeds the capacity. On failure it leaves no OpenGL error,
 * changes no state and draws nothing.
 * Context thread, while no other call changes the scene. Errors: INVALID_ARGUMENT (the message names the
 * field, its value and what is needed), OUT_OF_MEMORY, GL (the OpenGL context was lost). */
NOOK_API nook_result nook_world_render(nook_world pass, const nook_gl_frame_desc* frame,
                                       const nook_world_frame_desc* desc);

typedef struct nook_world_info {
  uint32_t struct_size;
  /* The pass's own texture, max_width x max_height, which Nook owns: GL_R8, or GL_RGBA8 for a coloured pass.
   * It is 1 everywhere before the first frame. */
  uint32_t texture;
  /* For your shaders: the table of the last frame's capsules that may darken its view, a texture for
   * caster_target (a texture buffer, or a 2D texture on OpenGL ES); and its numbers of groups (bodies) and
   * capsules. */
  uint32_t caster_texture, caster_target;
  int32_t group_count, caster_count;
  /* The bytes of the pass's textures and table. */
  uint64_t texture_bytes;
  /* GLSL to put after the #version line: float nook_world_open(vec3 point, vec3 normal) returns AO; arguments
   * are in view space. Set its uniforms nook_world_casters (a sampler) and nook_world_groups (an int). */
  const char* glsl;
} nook_world_info;

/* Describes a pass, without an OpenGL call. Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_world_describe(nook_world pass, nook_world_info* info);

#ifdef __cplusplus
}
#endif
#endif
