/* Characters darken the world: AO and the soft shadow of one light on what is not their own, from capsules.
 * `nook bake character` fits at most 64 capsules, each rigid to one bone, to a body against ray tracing, and
 * stores them in the model's file. The instances of a scene cast with them; so do the scene's free occluders,
 * as spheres, and the capsules that you pass in nook_world_frame_desc. AO: the share of a point's
 * cosine-weighted hemisphere that a capsule covers has a closed form, exact if the capsule is above the
 * horizon. The bake fits a scale for its radii. What capsules leave open multiplies. Light: a cone of
 * directions is cut into NOOK_WORLD_CONE_PARTS equal parts. In each, what the capsules leave open multiplies,
 * and the light's open share is the mean over the parts. Light by channel: with lobes you get a shadow with
 * direction and colour. A capsule that covers a share f of the hemisphere takes f rho of the light. For each
 * channel, rho is the mean radiance behind it divided by the hemisphere's mean radiance. A capsule before a
 * bright window darkens more than one before a wall. Under constant light the result is AO. Below 24 lobes,
 * SH bands 0 to 2 count; from 24 on, 0 to 4. nook_world_sample of experimental/nook_world_sample.h computes
 * the same at points on the CPU. */
#ifndef NOOK_WORLD_H
#define NOOK_WORLD_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The pass ----
 *
 * After depth, one call darkens the whole screen by the capsules of a scene, also by those that the screen
 * does not show. Pass the frame of the screen pass (nook_nnao.h), and the scene. The pass follows the state
 * contract of nook_gl_create, on every tier.
 * With the screen pass, draw 1 into green of the G-buffer AO where a character is, and its AO into red. The
 * texture of the world pass is then AO of everything (docs/guide/world.md has recipes without a mask):
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
  /* Pixels; the maximum size of a frame, 1 to 16384. Required. */
  int32_t max_width, max_height;
  /* Capsules and bodies that there is room for from the start, 1 to 1,048,576, default 4096; more make more
   * room. */
  uint32_t capsules;
  /* 1: AO is computed at half width and height, and upsampled by a joint-bilateral filter. Default 0. */
  int32_t half_resolution;
  /* 1: the pass also computes light, into a GL_RGBA8 texture. Red, green and blue get the open share of the
     light of nook_world_frame_desc.lobes, and alpha gets the open share of the cone of its light_axis.
     Default 0. */
  int32_t coloured;
} nook_world_desc;
static inline nook_result nook_world_desc_init(nook_world_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates textures and shaders. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the size exceeds the textures of this OpenGL, or the
 * casters its tables), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_world_create(nook_gl gl, const nook_world_desc* desc, nook_world* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. You may destroy the
 * nook_gl before, but its OpenGL context must be current; after nook_gl_context_lost none is needed. Context
 * thread. */
NOOK_API void nook_world_destroy(nook_world* pass);

/* How the darkening w by capsules is combined with AO s of another kind. */
enum {
  /* s w: s excludes darkening by the capsules, as nook_nnao_render does with NOOK_GBUFFER_AO_EXCLUDE. */
  NOOK_WORLD_COMBINE_MULTIPLY = 0,
  /* min(s, w): s has it as well. */
  NOOK_WORLD_COMBINE_MIN = 1
};
typedef int32_t nook_world_combine;

typedef struct nook_world_frame_desc {
  uint32_t struct_size, type;
  /* NULL, or a nook_world_frame_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* Its instances, in their poses, and its occluders cast. NULL (default): only `capsules` cast. */
  nook_scene scene;
  /* Capsules besides the scene's, in world space; default none. */
  const nook_capsule* capsules;
  uint32_t capsule_count;
  /* AO, 0 to 1, default 1/1024: a body does not reach points from which it would take less. 0: no limit. */
  float cutoff_error;
  /* AO, 0 to 1, default 1/256: far away one capsule stands for a limb, and farther for a body, where the rms
   * of the difference is about this. 0: every capsule counts. */
  float level_error;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power; in [0, 16] and (0, 16], both default to 1. */
  float intensity, power;
  /* Its red channel has AO of another kind, such as from nook_nnao_render for the same frame. It must be a 2D
     texture of the frame's size, in floats or normalised integers. The result combines both. Default 0:
     none. */
  uint32_t ao_texture;
  /* Default NOOK_WORLD_COMBINE_MULTIPLY. */
  nook_world_combine combine;
  /* The light whose open share a coloured pass computes by channel: at most NOOK_PROBE_MAX_FUNCTIONS lobes in
   * world space. Strength, G-buffer AO and combine act on each channel as on AO. Default none: all three are
   * AO. */
  const nook_lobe* lobes;
  uint32_t lobe_count;
  /* The light whose open share a coloured pass writes to alpha. Set the unit vector towards it in world
   * space, and the full angle of its cone in degrees, above 0 and below 179. Where G-buffer AO replaces the
   * result, alpha is 1; strength and combine do not change it. Default 0 degrees: none, alpha is 1. */
  float light_axis[3];
  float light_degrees;
  /* Capsules farther from a point do not take the cone's light from it. 0 (default): 30 metres. */
  float light_reach;
} nook_world_frame_desc;
static inline nook_result nook_world_frame_desc_init(nook_world_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* Draws the AO of a frame; the AO of sky is exactly 1, or the value of ao_texture. With
 * NOOK_GBUFFER_AO_REPLACE or _EXCLUDE, the frame's gbuffer_ao_texture is a mask: where its green channel is
 * 1, such as on characters, its red channel is the result. The call reads nothing back and never waits for
 * the GPU, and allocates only where the capsules outgrow their room. On failure it leaves no OpenGL error,
 * changes no state and draws nothing.
 * Context thread, while no other call changes the scene. Errors: INVALID_ARGUMENT (the message names the
 * field, its value and what is needed), OUT_OF_MEMORY, GL (the OpenGL context was lost). */
NOOK_API nook_result nook_world_render(nook_world pass, const nook_gl_frame_desc* frame,
                                       const nook_world_frame_desc* desc);

typedef struct nook_world_info {
  uint32_t struct_size;
  /* The pass's own texture, which Nook owns: GL_R8, of a coloured pass GL_RGBA8, max_width x max_height, 1
   * everywhere before the first frame. */
  uint32_t texture;
  /* For your shaders: the table of capsules of the last frame that may reach its view, a texture of
   * caster_target (a texture buffer, or a 2D texture on OpenGL ES), its number of groups (bodies), and of
   * capsules. */
  uint32_t caster_texture, caster_target;
  int32_t group_count, caster_count;
  /* The bytes of the pass's textures and table. */
  uint64_t texture_bytes;
  /* GLSL for after the #version line: float nook_world_open(vec3 point, vec3 normal), in view space, with the
   * uniforms nook_world_casters (a sampler) and nook_world_groups (an int), which you set. */
  const char* glsl;
} nook_world_info;

/* Describes a pass, without an OpenGL call. Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_world_describe(nook_world pass, nook_world_info* info);

#ifdef __cplusplus
}
#endif
#endif
