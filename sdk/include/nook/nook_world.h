/* Characters darken the world: AO and the soft shadow of one light on what is not their own, from casters.
 *
 * A world caster is a capsule, the convex hull of two spheres, that is rigid to one bone. `nook bake
 * character` fits at most 64 of them to each body against ray tracing, on floors, on walls and on neighbours,
 * and stores them in the model's file. The instances of a scene (nook_character.h) cast with them, and so do
 * the scene's free occluders, as spheres, and the capsules that you pass in nook_world_frame_desc.
 *
 * AO: the share of a point's cosine-weighted hemisphere that a capsule covers has a closed form, exact where
 * the capsule is above the horizon. Casters overlap by the product of what each leaves open, as if they
 * covered the hemisphere independently; a caster counts in it with ao_scale times its radii, which the bake
 * fits. Light: a cone of directions is cut into NOOK_WORLD_CONE_PARTS equal parts. In each the product of
 * what the casters leave open counts, and the light's open share is the mean over the parts. Casters that
 * cover different parts thus add, and those that cover one part whole darken it once.
 *
 * Light by channel: with lobes you get a shadow with direction and colour. A capsule that covers a share f of
 * the hemisphere takes f rho of the light; rho, for each channel, is the mean radiance behind it divided by
 * the mean radiance of the hemisphere. A capsule before a bright window darkens more than one before a wall.
 * Under constant light the result is AO. Below 24 lobes, SH bands 0 to 2 count; from 24 on, 0 to 4.
 *
 * nook_world_render darkens what a depth buffer shows. nook_world_sample of experimental/nook_world_sample.h
 * computes the same at points on the CPU. */
#ifndef NOOK_WORLD_H
#define NOOK_WORLD_H

#include "nook_gl.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The pass ----
 *
 * Characters darken what a depth buffer shows. The pass computes this AO at each pixel on the GPU.
 *
 * After depth, one call darkens the whole screen by the capsules of a scene, also by capsules that the screen
 * does not show. You pass the frame that the screen pass (nook_nnao.h) takes as well, and the scene. The pass
 * follows the state contract that was chosen at nook_gl_create, on every tier.
 *
 * With the screen pass, so that both darken once: draw 1 into green of the G-buffer AO where a character is,
 * and its AO into red.
 *     frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;  frame.gbuffer_ao_texture = characters;
 *     nook_nnao_render(nnao, &frame, &nnao_desc);
 *     desc.ao_texture = nnao_info.texture;
 *     nook_world_render(world, &frame, &desc);
 * The texture of the world pass is then AO of everything.
 *
 * Under probes and one lamp or sun, with nook_world_desc.coloured, desc.lobes and desc.light_axis:
 *     vec4 open = texelFetch(world_texture, pixel, 0);
 *     colour = albedo / pi * (irradiance_of_lobes * open.rgb + irradiance_of_lamp * open.a);
 *
 * The casters of a frame go through lists of tiles of 32 pixels, larger ones where OpenGL has no room for so
 * many: a body is in the lists of the tiles that its reach may cover on the screen. */

typedef struct nook_world_desc {
  /* nook_world_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t type;
  /* Must be NULL. */
  const void* next;
  /* Pixels; the maximum size of a frame, 1 to 16384. Required. */
  int32_t max_width, max_height;
  /* Capsules and groups (bodies) that the pass has room for from the start, 1 to 1,048,576, default 4096; it
   * makes more room when a frame has more. */
  uint32_t capsules;
  /* 1: AO is computed at half width and half height, and upsampled by a joint-bilateral filter. Default 0. */
  int32_t half_resolution;
  /* 1: the pass computes light as well, into a texture GL_RGBA8: in red, green and blue the open share of the
   * light of nook_world_frame_desc.lobes, in alpha that of the cone of its light_axis. Default 0. */
  int32_t coloured;
} nook_world_desc;

/* Fills *desc with defaults. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
static inline nook_result nook_world_desc_init(nook_world_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates textures and shaders. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the size exceeds the textures of this OpenGL, or the
 * casters its tables), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_world_create(nook_gl gl, const nook_world_desc* desc, nook_world* out);

/* Deletes every OpenGL object of the pass and sets *pass to NULL; *pass may be NULL. The nook_gl may have
 * been destroyed before, but its OpenGL context must be current; after nook_gl_context_lost none is needed.
 * Context thread. */
NOOK_API void nook_world_destroy(nook_world* pass);

/* The composition of the darkening w by casters with AO s of another kind. */
enum {
  /* s w: the casters have no part in s, as in that of nook_nnao_render with NOOK_GBUFFER_AO_EXCLUDE. */
  NOOK_WORLD_COMBINE_MULTIPLY = 0,
  /* min(s, w): s has the casters' darkening as well. */
  NOOK_WORLD_COMBINE_MIN = 1
};
typedef int32_t nook_world_combine;

typedef struct nook_world_frame_desc {
  /* nook_world_frame_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t type;
  /* NULL, or a nook_world_frame_debug_desc of experimental/nook_debug.h. */
  const void* next;
  /* Its instances and occluders cast, as in nook_world_sample; NULL (default): only `capsules` cast. The
   * poses are those of the last nook_scene_set_pose. */
  nook_scene scene;
  /* Capsules besides the scene's, in world space; default none. */
  const nook_capsule* capsules;
  uint32_t capsule_count;
  /* AO, 0 to 1, default 1/1024: a body does not reach points from which it takes less, by the bound that
   * nook_world_sample states times the cosine between the normal and the highest point of the sphere round
   * the body. 0: every body reaches every point. */
  float cutoff_error;
  /* AO, 0 to 1, default 1/256: beyond a distance one capsule stands for the casters of a limb, and beyond
   * another one for those of a body, where the rms of the difference is about this. 0: every caster counts.
   */
  float level_error;
  /* AO becomes max(0, 1 - intensity * (1 - AO)) ^ power. intensity is in [0, 16] and power in (0, 16]; both
   * default to 1. */
  float intensity, power;
  /* AO of another kind in its red channel, such as the texture of nook_nnao_render for the same frame: a 2D
   * texture of the frame's width x height, in floats or normalised integers. The result combines it with the
   * AO of the capsules. Default 0: none. */
  uint32_t ao_texture;
  /* Default NOOK_WORLD_COMBINE_MULTIPLY. */
  nook_world_combine combine;
  /* The light whose open share a coloured pass computes by channel, as nook_world_sample does: at most
   * NOOK_PROBE_MAX_FUNCTIONS lobes in world space. Strength, G-buffer AO and combine act on each channel as
   * on AO. Default none: all three channels are AO. */
  const nook_lobe* lobes;
  uint32_t lobe_count;
  /* The light whose open share a coloured pass leaves in alpha: towards it, of unit length in world space,
   * and the full angle of its cone in degrees, more than 0, less than 179. Where G-buffer AO replaces the
   * result it is 1; strength and combine leave it. Default 0 degrees: none, alpha is 1. */
  float light_axis[3];
  float light_degrees;
  /* Metres, more than 0; a caster that is farther from a point does not take the cone's light from it.
   * Default 30. */
  float light_reach;
} nook_world_frame_desc;

/* Fills *desc with defaults. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
static inline nook_result nook_world_frame_desc_init(nook_world_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* Draws the AO of a frame; the AO of sky is exactly 1, or the value of ao_texture. With
 * NOOK_GBUFFER_AO_REPLACE or _EXCLUDE, frame->gbuffer_ao_texture is a mask: where its green channel is 1,
 * such as on characters, its red channel is the result. The call reads nothing back and never waits for the
 * GPU, and allocates only where the capsules outgrow their room. On failure it leaves no OpenGL error,
 * changes no state and draws nothing. Context thread, while no other call changes the scene. Errors:
 * INVALID_ARGUMENT (the message names the field, its value and what is needed), OUT_OF_MEMORY, GL (the OpenGL
 * context was lost). */
NOOK_API nook_result nook_world_render(nook_world pass, const nook_gl_frame_desc* frame,
                                       const nook_world_frame_desc* desc);

typedef struct nook_world_info {
  /* sizeof(nook_world_info); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of the pass's own texture: GL_R8, of a coloured pass GL_RGBA8, max_width x max_height, 1
   * everywhere before the first frame. Nook owns it; the host reads it. */
  uint32_t texture;
  /* For shaders of the host: the table of casters of the last frame that may reach its view, a texture of
   * caster_target (a texture buffer, or a 2D texture on OpenGL ES), and the number of its groups (bodies). */
  uint32_t caster_texture;
  uint32_t caster_target;
  int32_t group_count;
  /* Casters in the table. */
  int32_t caster_count;
  /* The bytes of the pass's textures and table. */
  uint64_t texture_bytes;
  /* GLSL to put after the #version line: float nook_world_open(vec3 point, vec3 normal), in view space, with
   * the uniforms nook_world_casters (a sampler) and nook_world_groups (an int), which the host sets. */
  const char* glsl;
} nook_world_info;

/* Describes a pass. The call makes no OpenGL call.
 * Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_world_describe(nook_world pass, nook_world_info* info);

#ifdef __cplusplus
}
#endif
#endif
