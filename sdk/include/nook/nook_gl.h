/* The OpenGL functions: characters on the GPU, the frame of the screen pass and the world pass, and uploads
 * of probes, materials and clips for your shaders. Nook needs OpenGL 3.3 core, OpenGL ES 3.0, WebGL 2 or
 * newer, and includes no OpenGL header.
 *
 * Create one nook_gl for each OpenGL context in which you call Nook. Once per frame, after you set the poses,
 * call nook_gl_scene_update. For each character, bind the view of nook_gl_scene_view as a vertex attribute,
 * and multiply the ambient term (not the direct light) of the material by it:
 *     glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
 *     glVertexAttribPointer(slot, 1, GL_FLOAT, GL_FALSE, view.stride, (const void*)(uintptr_t)view.offset);
 * The i-th value belongs to the i-th vertex of the imported file, one primitive after another; see
 * nook_model_describe_primitive. "Texture buffer" means a GL_TEXTURE_BUFFER; on OpenGL ES and WebGL it means
 * a GL_TEXTURE_2D, and Nook's GLSL declares its sampler accordingly. Before each call, end or pause transform
 * feedback, and end conditional rendering and queries that count primitives or samples. Calls that allocate
 * log the OpenGL errors of your earlier calls; other calls neither read nor clear OpenGL errors. Functions
 * make OpenGL calls unless their comment says otherwise. */
#ifndef NOOK_GL_H
#define NOOK_GL_H

#include "nook_character.h"
#include "nook_clips.h"
#include "nook_material.h"
#include "nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the address of an OpenGL function, or NULL. Nook calls it only inside nook_gl_create. */
typedef void* (*nook_gl_proc_fn)(void* user, const char* name);

/* The tiers: how Nook evaluates characters. Tiers 43 and ES31 evaluate spheres, shadows and vertices in
 * compute shaders. Tiers 33 and ES30 evaluate shadows at key points on the CPU, through the context's
 * parallel_for, and vertices by transform feedback. Tiers 33 and ES30 are faster on software renderers such
 * as Mesa's llvmpipe. As max_tier, 33 and ES30 mean the same, and so do 43 and ES31. */
enum {
  NOOK_GL_TIER_BEST = 0,
  NOOK_GL_TIER_33 = 33,
  NOOK_GL_TIER_43 = 43,
  /* OpenGL ES 3.0 and WebGL 2. */
  NOOK_GL_TIER_ES30 = 300,
  /* OpenGL ES 3.1 and 3.2. */
  NOOK_GL_TIER_ES31 = 310
};
typedef int32_t nook_gl_tier;

/* How Nook treats the OpenGL state that it changes. docs/gl_state.md lists this state. */
enum {
  /* Each call queries the state and restores it. A query may stall a threaded driver. */
  NOOK_GL_STATE_PRESERVE = 0,
  /* Nook reads no state, and resets the state that it changed to OpenGL's defaults. Use this mode on WebGL,
   * where reads stall. */
  NOOK_GL_STATE_DEFAULTS = 1,
  /* Nook reads no state, and leaves the state that it changed undefined, so you must set it again. Rasterizer
   * discard and primitive restart are left disabled. */
  NOOK_GL_STATE_HOST = 2
};
typedef int32_t nook_gl_state_mode;

typedef struct nook_gl_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Required. Nook passes get_proc_user as the first argument. */
  nook_gl_proc_fn get_proc;
  void* get_proc_user;
  /* The highest tier to use; default NOOK_GL_TIER_BEST. state_mode is NOOK_GL_STATE_PRESERVE by default. */
  nook_gl_tier max_tier;
  nook_gl_state_mode state_mode;
  /* 1, for development: each call fails with NOOK_ERROR_GL unless the OpenGL context of nook_gl_create is
   * current, and frames that are unlikely to be meant are logged. Both checks query OpenGL. 0 (default):
   * if a wrong context is current, a call may return NOOK_OK and do nothing, or change your objects. */
  int32_t debug;
} nook_gl_desc;
static inline nook_result nook_gl_desc_init(nook_gl_desc* desc) {
  return nook_desc_init(NOOK_DESC_GL, desc, sizeof *desc, NOOK_VERSION);
}

/* Loads OpenGL functions and compiles shaders for the current OpenGL context. Host memory comes from the
 * context's allocator, except for one small allocation of the function loader. On failure *out is NULL and no
 * OpenGL object is left. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the message names the OpenGL
 * version or the missing function), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_create(nook_context context, const nook_gl_desc* desc, nook_gl* out);

/* Deletes all OpenGL objects of `gl` and sets *gl to NULL; *gl may be NULL. You may destroy the nook_context
 * and the scenes first. After nook_gl_context_lost, no OpenGL context is needed. Context thread. */
NOOK_API void nook_gl_destroy(nook_gl* gl);

/* Tells Nook that the OpenGL context is lost: `gl` forgets all OpenGL names and makes no OpenGL call.
 * Afterwards only nook_gl_describe and the destroy calls work; other calls fail with NOOK_ERROR_GL.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_context_lost(nook_gl gl);

typedef struct nook_gl_info {
  uint32_t struct_size;
  nook_gl_tier tier;
  /* GL_VERSION and GL_RENDERER of the OpenGL context; both are valid while `gl` lives. */
  const char* version;
  const char* renderer;
  /* The bytes of all OpenGL buffers of `gl` now, and the bytes of the buffers that hold AO. */
  uint64_t buffer_bytes, ao_bytes;
} nook_gl_info;

/* Describes `gl`, without an OpenGL call. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_describe(nook_gl gl, nook_gl_info* info);

/* Creates the OpenGL objects that the scene's instances need, so that the next nook_gl_scene_update allocates
 * nothing. The call is optional: an update also creates the objects of new instances. Existing instances keep
 * their AO and their view. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (a model or the scene
 * exceeds a limit of this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_prepare(nook_gl gl, nook_scene scene);

/* Evaluates the AO of all instances on the GPU. Call it in place of nook_scene_update; the values agree
 * within 2e-3, plus the change that far_error allows on the CPU. The call allocates host memory only after
 * you added instances, gave an instance its first light or set more lobes than before. It never waits for the
 * GPU. No other call may use the scene during this call. Context thread. Errors: INVALID_ARGUMENT,
 * UNSUPPORTED (as nook_gl_scene_prepare; also if the lights exceed the largest texture buffer of this OpenGL,
 * at least 65,536 texels; each light takes 12 + 2 * lobes texels), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_update(nook_gl gl, nook_scene scene);

/* Where an instance's values are stored. Each vertex has one float in [0, 1] for NOOK_CHANNEL_AO, or three
 * (red, green, blue) for NOOK_CHANNEL_DIRECTIONAL_AO. */
typedef struct nook_gl_view {
  uint32_t struct_size;
  /* A buffer that Nook owns. Read it, but never write or delete it. */
  uint32_t buffer;
  /* Bytes from the start of the buffer to the first vertex, and between the starts of two vertices. */
  uint64_t offset;
  uint32_t stride;
  /* The model's file_vertex_count. */
  uint32_t count;
  /* For NOOK_CHANNEL_DIRECTIONAL_AO, else 0: Nook's texture buffer with the lights of the scene. */
  uint32_t texture;
  /* For NOOK_CHANNEL_DIRECTIONAL_AO, else 0: the index of the instance's light, which is the first argument
   * of the GLSL functions; valid until the next update. */
  int32_t light;
  /* GLSL 3.30 and GLSL ES 3.00 text, without #version and precision lines, with the functions nook_scene_*.
   * The text is the same for every scene and channel, and valid while the library is loaded. */
  const char* glsl;
} nook_gl_view;

/* Describes the buffer that holds the values of an instance: for NOOK_CHANNEL_AO, or for
 * NOOK_CHANNEL_DIRECTIONAL_AO if the instance had a light in the last nook_gl_scene_update. Buffer, offset
 * and texture stay the same until you remove the instance, destroy the scene or `gl`, or call
 * nook_gl_scene_release or nook_scene_set_model. AO is 1 before the first update. After an update you need no
 * barrier to read the values as vertex attributes, texture buffers, shader storage or by buffer reads. This
 * function makes no OpenGL call. Context thread. Errors: INVALID_ARGUMENT (also for NOOK_CHANNEL_BENT_NORMAL,
 * which your vertex shader computes), INVALID_HANDLE (the id is unknown, the instance is not prepared yet, or
 * it had no light), GL. */
NOOK_API nook_result nook_gl_scene_view(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                        nook_channel channel, nook_gl_view* view);

/* Copies the values of a view to host memory: `count` vertices in the order of nook_scene_read. The call
 * WAITS FOR THE GPU: use it in tests and tools. Context thread. Errors: those of nook_gl_scene_view. */
NOOK_API nook_result nook_gl_scene_read(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                        nook_channel channel, float* out, uint32_t count);

/* Your buffer or texture to which nook_gl_scene_write writes AO. Set all fields to 0 first. */
typedef struct nook_gl_ao_target {
  /* sizeof(nook_gl_ao_target). */
  uint32_t struct_size;
  /* The format of the values in a buffer. In a texture, values have the texture's format. On OpenGL ES,
   * uploads do not convert, so set the texture's format here: NOOK_FORMAT_FLOAT for GL_R32F, _HALF for
   * GL_R16F, _UNORM8 for GL_R8. */
  nook_format format;
  /* The OpenGL name of a buffer that is not mapped, or 0. */
  uint32_t buffer;
  /* The OpenGL name of a GL_TEXTURE_2D with a red channel of floats or normalised integers, or 0. The value
   * of vertex i goes to texel i, row by row. */
  uint32_t texture;
  /* The offset of the first value. In a buffer: bytes, a multiple of 4; in a texture: texels. */
  uint64_t offset;
  /* If count > 1: the distance between the first values of consecutive instances, in the same units. */
  uint64_t instance_stride;
  /* Bytes between the starts of two values in a buffer, a multiple of 4, for AO interleaved with other vertex
   * attributes; each value then occupies 4 bytes. Needs compute shaders. 0: tightly packed; the bytes of an
   * instance are padded to a multiple of 4, and the padding is overwritten. */
  uint32_t stride;
  /* The texture's width in texels. Required on OpenGL ES 3.0 and WebGL 2; elsewhere, 0 lets Nook query it. */
  uint32_t texture_width;
} nook_gl_ao_target;

/* Copies the AO of the last nook_gl_scene_update to your own buffer or texture on the GPU. The values of the
 * `count` instances are written in the order of `instances`. You need no barrier before vertex fetches,
 * texture fetches and buffer reads. The call does not wait for the GPU. The first call with a format creates
 * a program. Context thread. Errors: INVALID_ARGUMENT (also if the target is too small), INVALID_HANDLE (an
 * id is unknown, or an instance is not prepared yet), UNSUPPORTED (a stride without compute shaders), GL. */
NOOK_API nook_result nook_gl_scene_write(nook_gl gl, nook_scene scene, const nook_instance_id* instances,
                                         uint32_t count, const nook_gl_ao_target* target);

/* ---- Directional occlusion: nook_scene_set_light, evaluated for each vertex on the GPU ----
 *
 * For each instance with a light, nook_gl_scene_update writes a colour for each vertex, which you use instead
 * of AO, and puts the lobes of all lights into a texture buffer. Put the glsl of nook_gl_view after the
 * #version line of your vertex or fragment shader, bind view.texture to a texture unit (GL_TEXTURE_BUFFER; on
 * OpenGL ES GL_TEXTURE_2D), and set the sampler nook_scene_lights to this unit. For each draw, set the values
 * as an attribute of three floats, and view.light as a uniform. In the shader, n is the unit normal in world
 * space:
 *     vec3 e = nook_scene_irradiance(light, n, directional_ao);
 *     colour = albedo / 3.14159265 * e;
 * nook_scene_open_irradiance(light, n) is the irradiance without occlusion. A shader may contain both this
 * text and the text of a probe upload, in any order. The values agree with nook_scene_read within 4e-3; the
 * difference comes from two approximate square roots per term. */

/* Deletes the OpenGL objects that `gl` holds for a scene, but not the scene. All views (nook_gl_view) of the
 * scene's instances become invalid. Without this call, the objects of a destroyed scene are deleted by the
 * next update or by nook_gl_destroy. Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene);

/* ---- A frame of the host ----
 *
 * nook_gl_frame_desc describes the images and the camera, for nook_nnao_render and nook_world_render. */

/* The contents of a depth texture. */
enum {
  /* The depth that OpenGL wrote with the matrix `projection` and the depth range [0, 1] of glDepthRange. Pass
   * a texture of a depth format, or a copy in the red channel of a 32-bit float texture. */
  NOOK_DEPTH_HARDWARE = 0,
  /* -z of view space in metres, in the red channel of a float texture. */
  NOOK_DEPTH_LINEAR = 1,
  /* Your shader wrote log2(1 + C (w - n)) / log2(1 + C (f - n)) to gl_FragDepth, or to the red channel of a
   * 32-bit float texture. w is -z of view space; C, n and f are depth_log_scale, depth_log_near and
   * depth_log_far; values >= 1 are sky. Only for perspective projections. three.js uses C = 1 and n = 0,
   * Cesium uses C = 1 and its near plane. */
  NOOK_DEPTH_LOGARITHMIC = 2
};
typedef int32_t nook_depth_kind;

/* The depth range of clip space: OpenGL's default, or glClipControl(..., GL_ZERO_TO_ONE). */
enum { NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE = 0, NOOK_CLIP_SPACE_ZERO_TO_ONE = 1 };
typedef int32_t nook_clip_space;

/* How a pass combines its AO, s, with AO that you draw into a texture yourself (G-buffer AO). The red channel
 * of your texture, c, holds AO of another kind, such as from nook_gl_scene_update; set it to 1 where you have
 * none. The green channel, w, is a weight. */
enum {
  /* The result is s. */
  NOOK_GBUFFER_AO_NONE = 0,
  /* min(s, c): occlusion that both s and c contain is applied only once. */
  NOOK_GBUFFER_AO_MIN = 1,
  /* min(s, c) / c. Multiply it into an image that already contains the factor c; the product is min(s, c). */
  NOOK_GBUFFER_AO_REMAINDER = 2,
  /* (1 - w) s + w c: where w is 1, the result is the G-buffer AO alone. */
  NOOK_GBUFFER_AO_REPLACE = 3,
  /* (1 - w) s + w c. In addition, surfaces with w > 0.5 do not occlude in the screen pass. Use it for
   * characters that darken the world by their capsules in nook_world_render, so that they darken the world
   * only once. */
  NOOK_GBUFFER_AO_EXCLUDE = 4
};
typedef int32_t nook_gbuffer_ao;

/* Where a pass writes its result. */
enum {
  /* A texture that the pass owns; see nook_nnao_info and nook_world_info. */
  NOOK_TARGET_OWN = 0,
  /* Level 0 of your own 2D texture, or of your texture array for passes with views. */
  NOOK_TARGET_TEXTURE = 1,
  /* The first draw buffer of your own framebuffer; framebuffer 0 is the window. The contents of other draw
   * buffers become undefined. Not for passes with views. */
  NOOK_TARGET_FRAMEBUFFER = 2
};
typedef int32_t nook_target;

/* How the result changes the target. */
enum {
  /* The target becomes (ao, ao, ao, 1), or the bent normal and ao; see nook_nnao_desc.bent_normals. */
  NOOK_BLEND_WRITE = 0,
  /* The target's colour is multiplied by ao; its alpha is not changed. Not with NOOK_TARGET_OWN. */
  NOOK_BLEND_MULTIPLY = 1
};
typedef int32_t nook_blend;

/* One frame. Textures are 2D and single-sampled, unless you created the pass with `views` or `depth_samples`.
 * The pass reads width x height texels of level 0, through its own samplers. The pass remembers the last four
 * sets of textures. It queries OpenGL when it sees a set for the first time, and once more when you use the
 * set again after another set. */
typedef struct nook_gl_frame_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The size of every texture of the frame in pixels, at most the maximum size of the pass. Required. */
  int32_t width, height;
  /* x, y, width and height, in pixels, of the part of the images that `projection` covers. Nook reads and
   * writes nothing outside it. All 0 (default): the whole frame. */
  int32_t viewport[4];
  /* The depth texture is required. The default depth_kind is NOOK_DEPTH_HARDWARE. */
  uint32_t depth_texture;
  nook_depth_kind depth_kind;
  /* Only for linear depth, in metres: pixels at this depth or beyond are sky, where AO is exactly 1. 0
   * (default): no limit. Pixels are also sky if their depth is not finite, is <= 0 in a perspective
   * projection, or is hardware depth at the far plane. */
  float sky_depth;
  /* For logarithmic depth: C in 1/metres, > 0, default 1; n in metres, >= 0, default 0; f in metres, > n,
   * required. */
  float depth_log_scale, depth_log_near, depth_log_far;
  /* A texture of normals. 0 (default): the pass reconstructs normals from depth. */
  uint32_t normal_texture;
  /* The normal is normal_matrix * (texel * normal_scale + normal_bias), then normalised. The defaults are 1
   * and 0; normals that are stored as (n + 1) / 2 need 2 and -1. Normals shorter than 0.001 (0.25 in
   * normalised integers) are reconstructed from depth, so clear the texture to n = 0. */
  float normal_scale, normal_bias;
  /* Transforms normals to view space; column-major. The identity by default. */
  float normal_matrix[9];
  /* Column-major; required. It may be off-centre, orthographic, reversed-depth, infinite or oblique. */
  float projection[16];
  /* From world space to view space, column-major: a rotation and a translation. The identity by default. The
   * world pass needs it. With max_history_frames, the screen pass uses it to find each surface in the last
   * frame; set nook_nnao_frame_desc.reset after a cut. */
  float view[16];
  /* Only used for hardware depth. Default NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE. */
  nook_clip_space clip_space;
  /* Default NOOK_GBUFFER_AO_NONE. All other values require gbuffer_ao_texture. */
  nook_gbuffer_ao gbuffer_ao;
  uint32_t gbuffer_ao_texture;
  /* Default NOOK_TARGET_OWN. */
  nook_target target;
  /* The OpenGL name of your texture or framebuffer. Pixel (x, y) of the frame is written to its pixel (x, y).
   * sRGB formats are written and multiplied in linear light. */
  uint32_t target_name;
  /* Default NOOK_BLEND_WRITE. */
  nook_blend blend;
  /* Set 1 if, since the last call, a new texture or target got the name of an old one. Default 0. */
  int32_t textures_changed;
  /* For passes with views: matrices of 16, 16 and 9 floats for each view, which replace `projection`, `view`
   * and `normal_matrix`. NULL (default): all views use the single matrix above. */
  const float* view_projections;
  const float* view_matrices;
  const float* view_normal_matrices;
} nook_gl_frame_desc;
static inline nook_result nook_gl_frame_desc_init(nook_gl_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_GL_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* ---- Uploads: probes, materials and clips in shaders ----
 *
 * An upload stores a probe, a grid, a material or baked clips in textures, with the GLSL that reads them.
 * Upload once. Put the GLSL of nook_gl_upload_describe after the #version line of your shader. Before a draw,
 * call nook_gl_upload_bind with your program. */

/* One texture of an upload. */
typedef struct nook_gl_upload_texture {
  /* The target to bind it to: GL_TEXTURE_BUFFER, GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY or GL_TEXTURE_3D. */
  uint32_t target;
  /* A texture that Nook owns. Bind it, but never change or delete it. */
  uint32_t texture;
  /* The name of its sampler in the GLSL, valid while the upload lives. */
  const char* uniform;
} nook_gl_upload_texture;

typedef struct nook_gl_upload_info {
  uint32_t struct_size;
  /* The number of textures, at most 16. A draw needs as many texture units. */
  uint32_t texture_count;
  nook_gl_upload_texture textures[16];
  /* The bytes of all textures. On OpenGL ES, 2D textures of 2048 texels per row replace texture buffers. */
  uint64_t bytes;
  /* GLSL 3.30 and GLSL ES 3.00 text, without #version and precision lines. It is valid until you update or
   * destroy the upload. All names in Nook's GLSL begin with nook_, Nook or NOOK_. */
  const char* glsl;
  /* The name of a uniform for constants, or NULL: nook_grid_frame for a grid, nook_clip_vec4s for clips. */
  const char* constant;
  /* Values for glUniform4fv, constant_vec4s * 4 floats; or an int for glUniform1i if constant_vec4s is 0. */
  float constant_values[16];
  uint32_t constant_vec4s;
  /* 1: the grid has walls, and each surface uses only the probes on its side of a wall. */
  int32_t walls;
} nook_gl_upload_info;

/* Describes an upload, for your shaders, and for engines that bind textures themselves. Makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_upload_describe(nook_gl_upload upload, nook_gl_upload_info* info);

/* Prepares a draw with `program`. Binds the textures to the texture units from `first_unit` on, without
 * sampler objects, and sets the program's sampler uniforms and constants. In every nook_gl_state_mode, the
 * program stays in use and the textures stay bound; state_mode applies only to the active texture unit. The
 * program may lack samplers that your shader does not use. If it lacks all samplers of the upload, the call
 * fails and changes nothing; the message names the upload that the program was compiled for.
 * Context thread. Errors: INVALID_ARGUMENT (program is not a linked program, was compiled with the GLSL of
 * another kind of upload, or first_unit + texture_count exceeds GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS), GL. */
NOOK_API nook_result nook_gl_upload_bind(nook_gl_upload upload, uint32_t program, uint32_t first_unit);

/* Deletes the OpenGL objects and sets *upload to NULL; *upload may be NULL. You may destroy the nook_gl
 * first. Its OpenGL context must be current, unless it was lost (nook_gl_context_lost). Context thread. */
NOOK_API void nook_gl_upload_destroy(nook_gl_upload* upload);

/* ---- Probes in shaders ----
 *
 * The form LOBES stores the lobes of a probe or a grid in a texture buffer, for the sampler
 * nook_probe_texels. Your shader:
 *     NookProbeSurface surface =
 *         NookProbeSurface(normal_ws, view_ws, tangent_ws, vec2(alpha_x, alpha_y), reflectance);
 *     NookProbePlace place = nook_probe_place(position_ws);  // once: the probes around a point
 *     vec3 e = nook_probe_irradiance(place, normal_ws);
 *     colour = nook_probe_ambient(albedo, e, vec3(ao));  // or directional occlusion instead of ao
 *     colour += nook_probe_specular_anisotropic(place, surface) *
 *               nook_probe_specular_occlusion(ao, n_dot_v, roughness);
 * For a single lobe, such as one in a uniform block, call nook_sg_lobe_radiance, nook_sg_lobe_irradiance and
 * so on; shaders/probe documents them. NookLobe has the layout of nook_lobe in std140 and std430. The GLSL
 * agrees with nook_probe.h within 1e-4 of the largest value, and is the same for every probe. The forms SH
 * and ZH3 store a grid of diffuse light in a 3D texture of GL_RGBA16F, which the hardware filters. SH takes 7
 * fetches per pixel, and ZH3 takes 4, or up to 40 if the grid has walls. Both forms are smaller and faster
 * than lobes. The sampler is nook_grid_texels, and the constant is nook_grid_frame. Your shader:
 *     vec3 e = nook_grid_irradiance(position_ws, normal_ws);
 * experimental/nook_capture.h fills these textures at run time from cube maps that your engine renders. */

/* What an upload stores for each probe. */
enum {
  /* Bands 0 to 2 of spherical harmonics, 27 half floats. */
  NOOK_GL_PROBE_SH = 0,
  /* ZH3, see nook_sh_to_zh3 of experimental/nook_sg.h; 15 half floats. */
  NOOK_GL_PROBE_ZH3 = 1,
  /* The lobes of the probe, with four floats for each lobe. */
  NOOK_GL_PROBE_LOBES = 2
};
typedef int32_t nook_gl_probe_form;

/* Uploads a probe or a grid in the given form. SH and ZH3 include the walls if the grid was baked with them.
 * You may destroy the probe afterwards. For SH and ZH3, lobes are projected exactly, and bands above 2 are
 * left out. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT (LOBES: the basis of the probe is not NOOK_PROBE_BASIS_LOBES; SH
 * and ZH3: the probe's basis is ambient dice, or a coefficient is above 65504), UNSUPPORTED (LOBES: the 3 +
 * lobes * (1 + probes) texels exceed the texture buffer of this OpenGL, which has at least 65,536; SH and
 * ZH3: a side of the texture exceeds GL_MAX_3D_TEXTURE_SIZE, which is at least 256; the sides are counts x,
 * counts y and 7 counts z, or 4 counts z for ZH3, plus 5 counts z with walls), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_probe(nook_gl gl, nook_probe probe, nook_gl_probe_form form,
                                          nook_gl_upload* out);

/* Replaces the probe or grid of an upload, in the same form. The textures keep their names. Draws that you
 * issued before the call still read the old values. The upload's constant changes if the box of the grid
 * changes. The GLSL changes if only one of the old and the new grid has walls. On failure the upload keeps
 * the old probe.
 * Context thread. Errors: those of nook_gl_upload_probe, INVALID_ARGUMENT (the upload has no probe). */
NOOK_API nook_result nook_gl_update_probe(nook_gl_upload upload, nook_probe probe);

/* ---- Materials in shaders ----
 *
 * Put the GLSL after the #version line of your fragment shader. For each light (`irradiance` includes the
 * cosine):
 *     vec4 modes[NOOK_LIGHT_VEC4_COUNT];
 *     nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
 *     colour = nook_material_radiance(modes, light) * irradiance;
 *     alpha = nook_material_visibility(nook_material_occlusion(uv, dFdx(uv), dFdy(uv), view));
 * nook_material_decode and nook_material_occlusion take one fetch per mode, at the mipmap level of the
 * pixel's longer side. This blurs grazing views. The following functions stay sharp, because they take
 * several fetches along the longer side; `fetches` is a constant from 1 to NOOK_MATERIAL_MAX_FETCHES (see
 * nook_material_evaluate):
 *     nook_material_decode_anisotropic(uv, dFdx(uv), dFdy(uv), view, fetches, modes);
 *     alpha = nook_material_visibility(
 *         nook_material_occlusion_anisotropic(uv, dFdx(uv), dFdy(uv), view, fetches));
 * Each additional fetch of `fetches` costs further_decode_fetches texel fetches (nook_material_info). The
 * `modes` of a neural material are values inside its network, so you cannot add or mix them. Silhouettes of
 * the meso-structure need two passes over the same triangles. In the first pass, draw pixels with alpha = 1
 * and discard the others. In the second pass, blend pixels with 0 < alpha < 1 by alpha, with the depth test
 * but no depth writes. */

/* Uploads a material, which you may destroy afterwards, as GL_TEXTURE_2D_ARRAYs. Materials with the same
 * sizes and visibility mapping have the same GLSL and may share a program; a neural material needs its own
 * program. The uniform vec2 nook_visibility_mapping (a constant on OpenGL ES) holds threshold and weight; at
 * first, they are the values of the material. On failure *out is NULL and no OpenGL object is left. Context
 * thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the material needs more texture units, larger textures or
 * other blocks than this OpenGL supports), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_material(nook_gl gl, nook_material material, nook_gl_upload* out);

/* ---- Clips in shaders ----
 *
 * Your vertex shader decodes the AO of baked clips (nook_clips.h). nook_clips_frames computes `frames` and
 * `share` for each character; pass both as uniforms or as instance attributes. Your shader:
 *     float ao = nook_clip_ao(gl_VertexID, frames, share);
 * The first argument is the index of a file vertex. If gl_VertexID has another order, pass the index as an
 * attribute. For each vertex, the shader reads mode_count / 4 texels of modes and twice as many texels of
 * weights; the weights are the same for all vertices of a character. */

/* Uploads clips, which you may destroy afterwards, as two GL_TEXTURE_2Ds for the samplers nook_clip_modes and
 * nook_clip_weights. The constant is the integer nook_clip_vec4s. The GLSL has the function
 *     float nook_clip_ao(int vertex, ivec2 frames, float share);
 * and is the same for all clips. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (a table exceeds GL_MAX_TEXTURE_SIZE rows of 2048
 * texels), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_clips(nook_gl gl, nook_clips clips, nook_gl_upload* out);

#ifdef __cplusplus
}
#endif
#endif
