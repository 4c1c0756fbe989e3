/* The OpenGL functions: characters on the GPU, the frame of the screen pass and the world pass, and uploads
 * of probes, materials and clips for your shaders. Nook needs OpenGL 3.3 core, OpenGL ES 3.0, WebGL 2 or
 * newer, and includes no OpenGL header.
 *
 * Create one nook_gl for each OpenGL context that shares nothing with
 * another. Once per frame, after you set the poses, call nook_gl_scene_update. For each character, bind the
 * view of nook_gl_scene_view as a vertex attribute, and multiply the ambient term (not the direct light) of
 * the material by it:
 *     glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
 *     glVertexAttribPointer(slot, 1, GL_FLOAT, GL_FALSE, view.stride, (const void*)(uintptr_t)view.offset);
 * The i-th value belongs to the i-th vertex of the imported file, the primitives one after another; see
 * nook_model_describe_primitive. "Texture buffer" means a GL_TEXTURE_BUFFER, and on OpenGL ES and WebGL a
 * GL_TEXTURE_2D, where Nook's GLSL declares its sampler accordingly. At each call, no transform feedback may
 * be active unless it is paused, and neither conditional rendering nor a query that counts primitives or
 * samples. Calls that allocate report OpenGL errors that you left to the log; other calls neither read nor
 * clear them. Functions make OpenGL calls unless their comment says otherwise. */
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

/* The tiers of max_tier and nook_gl_info. 43 and ES31 evaluate spheres, shadows and vertices in compute
 * shaders. 33 and ES30 evaluate shadows at key points on the CPU, through the context's parallel_for, and
 * vertices by transform feedback; on software renderers such as Mesa's llvmpipe this is faster. As max_tier,
 * the two of a kind are alike. */
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

/* The treatment of the OpenGL state that Nook touches; docs/gl_state.md lists all of it. */
enum {
  /* Each call queries the state and restores it. A query may stall a threaded driver. */
  NOOK_GL_STATE_PRESERVE = 0,
  /* Nook reads no state, and leaves what it touched at OpenGL's defaults. For WebGL, where reads stall. */
  NOOK_GL_STATE_DEFAULTS = 1,
  /* Nook reads no state, and leaves what it touched undefined: set it again. Rasterizer discard and primitive
   * restart are left disabled. */
  NOOK_GL_STATE_HOST = 2
};
typedef int32_t nook_gl_state_mode;

typedef struct nook_gl_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Required; get_proc_user is its first argument. */
  nook_gl_proc_fn get_proc;
  void* get_proc_user;
  /* The highest tier to use; default NOOK_GL_TIER_BEST. state_mode is NOOK_GL_STATE_PRESERVE by default. */
  nook_gl_tier max_tier;
  nook_gl_state_mode state_mode;
  /* 1, for development: each call fails with NOOK_ERROR_GL unless the OpenGL context of nook_gl_create is
   * current, and frames without a surface are logged. Both query OpenGL. 0 (default): without this context, a
   * call may return NOOK_OK and do nothing, or change your objects. */
  int32_t debug;
} nook_gl_desc;
static inline nook_result nook_gl_desc_init(nook_gl_desc* desc) {
  return nook_desc_init(NOOK_DESC_GL, desc, sizeof *desc, NOOK_VERSION);
}

/* Loads functions and compiles shaders for the current OpenGL context. Host memory comes from the context's
 * allocator, except for one small allocation of the function loader. On failure *out is NULL and no OpenGL
 * object is left. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the message names the OpenGL version
 * or the missing function), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_create(nook_context context, const nook_gl_desc* desc, nook_gl* out);

/* Deletes every OpenGL object that gl created and sets *gl to NULL; *gl may be NULL. You may have destroyed
 * the context and the scenes before. After nook_gl_context_lost the call needs no OpenGL context.
 * Context thread. */
NOOK_API void nook_gl_destroy(nook_gl* gl);

/* Tells Nook that the OpenGL context is gone: gl forgets all OpenGL names without an OpenGL call. Afterwards
 * only nook_gl_describe and the destroy calls work, and others fail with NOOK_ERROR_GL.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_context_lost(nook_gl gl);

typedef struct nook_gl_info {
  uint32_t struct_size;
  nook_gl_tier tier;
  /* GL_VERSION and GL_RENDERER of the OpenGL context; both are valid while gl lives. */
  const char* version;
  const char* renderer;
  /* The OpenGL buffer memory that gl holds now, and the part of it that holds AO. */
  uint64_t buffer_bytes, ao_bytes;
} nook_gl_info;

/* Describes gl, without an OpenGL call. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_describe(nook_gl gl, nook_gl_info* info);

/* Creates the OpenGL objects that the scene's instances need, so that the next nook_gl_scene_update allocates
 * nothing. Optional: an update does the same when instances were added. Existing instances keep their AO and
 * their view. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (a model or the scene exceeds a limit of
 * this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_prepare(nook_gl gl, nook_scene scene);

/* Evaluates the AO of all instances on the GPU. Call it in place of nook_scene_update; the values agree
 * within 2e-3, beside what far_error of the scene changes there. It allocates host memory only if instances
 * were added, received their first light or have more lobes than the lights had room for, and never waits for
 * the GPU. No other call may use the scene meanwhile.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (as nook_gl_scene_prepare; also, the lights exceed
 * the texture buffer of this OpenGL: each takes 12 + 2 * lobes texels, and every OpenGL has 65,536), GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_update(nook_gl gl, nook_scene scene);

/* The place of an instance's values: one float in [0, 1] for each vertex for NOOK_CHANNEL_AO, three (red,
 * green, blue) for NOOK_CHANNEL_DIRECTIONAL_AO. */
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
  /* For NOOK_CHANNEL_DIRECTIONAL_AO, else 0: the instance's light, the first argument of the GLSL functions;
   * valid until the next update. */
  int32_t light;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions, with the functions nook_scene_*. The text
   * is the same for every scene and channel, and valid while the library is loaded. */
  const char* glsl;
} nook_gl_view;

/* Gives the view of an instance for NOOK_CHANNEL_AO, or for NOOK_CHANNEL_DIRECTIONAL_AO if the instance had a
 * light in the last nook_gl_scene_update. Buffer, offset and texture stay the same until the instance, the
 * scene or gl is destroyed, you call nook_gl_scene_release, or nook_scene_set_model gives the instance
 * another model. AO is 1 before the first update. After an update you may read the values as vertex
 * attributes, texture buffers, shader storage and by buffer reads without a barrier. The call makes no OpenGL
 * call.
 * Context thread. Errors: INVALID_ARGUMENT (also: NOOK_CHANNEL_BENT_NORMAL, which your vertex shader
 * computes), INVALID_HANDLE (the id is unknown, the instance is not prepared yet, or it had no light), GL. */
NOOK_API nook_result nook_gl_scene_view(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                        nook_channel channel, nook_gl_view* view);

/* Copies the values of a view to host memory, for count vertices in the order of nook_scene_read. The call
 * WAITS FOR THE GPU: use it in tests and tools. Context thread. Errors: those of nook_gl_scene_view. */
NOOK_API nook_result nook_gl_scene_read(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                        nook_channel channel, float* out, uint32_t count);

/* Where nook_gl_scene_write puts AO: a buffer or a texture of yours. Set all fields to 0 first. */
typedef struct nook_gl_ao_target {
  /* sizeof(nook_gl_ao_target). */
  uint32_t struct_size;
  /* The numbers in a buffer. A texture's own format decides instead; but on OpenGL ES, where uploads do not
   * convert, set its format here: NOOK_FORMAT_FLOAT for GL_R32F, _HALF for GL_R16F, _UNORM8 for GL_R8. */
  nook_format format;
  /* The OpenGL name of a buffer that is not mapped, or 0. */
  uint32_t buffer;
  /* The OpenGL name of a GL_TEXTURE_2D with a red channel of floats or normalised integers, or 0. The value
   * of vertex i goes to texel i, row by row. */
  uint32_t texture;
  /* Of the first value: bytes, a multiple of 4, or texels. */
  uint64_t offset;
  /* The distance from one instance's values to the next's: bytes, a multiple of 4, or texels. Only with count
     > 1. */
  uint64_t instance_stride;
  /* Bytes between the starts of two values in a buffer, a multiple of 4, for AO among other attributes of a
   * vertex; a value then owns a whole word. Needs compute shaders. 0: tightly packed; the bytes of an
   * instance are rounded up to a multiple of 4, and the padding is written. */
  uint32_t stride;
  /* Texels. Needed on OpenGL ES 3.0 and WebGL 2, which do not tell it; elsewhere 0 has it looked up. */
  uint32_t texture_width;
} nook_gl_ao_target;

/* Copies the AO of the last nook_gl_scene_update to a buffer or texture of yours on the GPU, for count
 * instances one after another. Vertices, texture fetches and buffer reads see the values without a barrier.
 * The call does not wait for the GPU. The first call with a format makes a program.
 * Context thread. Errors: INVALID_ARGUMENT (also: the target is too small), INVALID_HANDLE (an id is unknown,
 * or an instance is not prepared yet), UNSUPPORTED (a stride without compute shaders), GL. */
NOOK_API nook_result nook_gl_scene_write(nook_gl gl, nook_scene scene, const nook_instance_id* instances,
                                         uint32_t count, const nook_gl_ao_target* target);

/* ---- Directional occlusion: nook_scene_set_light, evaluated for each vertex on the GPU ----
 *
 * For each instance with a light, nook_gl_scene_update leaves a colour for each vertex that takes the place
 * of AO, and puts the lobes of all lights into a texture buffer. Put the glsl of nook_gl_view after the
 * #version line of your vertex or fragment shader, bind view.texture to a texture unit (GL_TEXTURE_BUFFER; on
 * OpenGL ES GL_TEXTURE_2D), and set the sampler nook_scene_lights to this unit. For each draw, set the values
 * as an attribute of three floats, and view.light as a uniform. In the shader, n is the unit normal in world
 * space:
 *     vec3 e = nook_scene_irradiance(light, n, directional_ao);
 *     colour = albedo / 3.14159265 * e;
 * nook_scene_open_irradiance(light, n) is the irradiance without occlusion. A shader may hold this text and
 * the text of an upload of a probe, in either order. The values agree with nook_scene_read within 4e-3,
 * because each term takes two estimates of a square root. */

/* Deletes the OpenGL objects that gl holds for a scene, which ends the views of its instances; the scene
 * lives on. Without this call the next update, or nook_gl_destroy, deletes the objects of a destroyed scene.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene);

/* ---- A frame of the host ----
 *
 * The images and the camera of one frame, which nook_nnao_render and nook_world_render take. */

/* The contents of a depth texture. */
enum {
  /* The depth that OpenGL wrote under `projection` and glDepthRange(0, 1): a texture of a depth format, or a
   * copy of it in the red channel of a 32-bit float texture. */
  NOOK_DEPTH_HARDWARE = 0,
  /* -z of view space in metres, in the red channel of a float texture. */
  NOOK_DEPTH_LINEAR = 1,
  /* Your shader wrote log2(1 + C (w - n)) / log2(1 + C (f - n)) to gl_FragDepth, or to the red channel of a
   * 32-bit float texture. w is -z of view space; C, n and f are depth_log_scale, depth_log_near and
   * depth_log_far; values of 1 and more are sky. Only with a perspective. three.js has C = 1 and n = 0,
   * Cesium has C = 1 and its near plane. */
  NOOK_DEPTH_LOGARITHMIC = 2
};
typedef int32_t nook_depth_kind;

/* The depth range of clip space: OpenGL's default, or glClipControl(..., GL_ZERO_TO_ONE). */
enum { NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE = 0, NOOK_CLIP_SPACE_ZERO_TO_ONE = 1 };
typedef int32_t nook_clip_space;

/* The combination of a pass's result s with AO that you draw yourself into a texture of the frame (G-buffer
 * AO). c is its red channel: AO of another kind, such as the AO of nook_gl_scene_update, and 1 where there is
 * none. w is its green channel, a weight. */
enum {
  /* s. */
  NOOK_GBUFFER_AO_NONE = 0,
  /* min(s, c): occlusion that both contain darkens once. */
  NOOK_GBUFFER_AO_MIN = 1,
  /* min(s, c) / c: for an image that c has already darkened, so that the product is min(s, c). */
  NOOK_GBUFFER_AO_REMAINDER = 2,
  /* (1 - w) s + w c: where w is 1, only the G-buffer AO counts. */
  NOOK_GBUFFER_AO_REPLACE = 3,
  /* (1 - w) s + w c, and the screen pass leaves out surfaces whose w is above 0.5 as occluders. Use it for
   * characters whose capsules darken the world in nook_world_render, so that they darken it once. */
  NOOK_GBUFFER_AO_EXCLUDE = 4
};
typedef int32_t nook_gbuffer_ao;

/* Where the result goes. */
enum {
  /* The pass's own texture; see nook_nnao_info and nook_world_info. */
  NOOK_TARGET_OWN = 0,
  /* Level 0 of a 2D texture of the host, or of a texture array for passes with views. */
  NOOK_TARGET_TEXTURE = 1,
  /* The first draw buffer of a framebuffer of the host; framebuffer 0 is the window. The contents of further
   * draw buffers become undefined. Not for passes with views. */
  NOOK_TARGET_FRAMEBUFFER = 2
};
typedef int32_t nook_target;

/* The change of the target by the result. */
enum {
  /* The target becomes (ao, ao, ao, 1), or the bent normal and ao; see nook_nnao_desc.bent_normals. */
  NOOK_BLEND_WRITE = 0,
  /* The target's colour is multiplied by ao, and its alpha stays. Not with NOOK_TARGET_OWN. */
  NOOK_BLEND_MULTIPLY = 1
};
typedef int32_t nook_blend;

/* One frame. Textures are 2D and single-sampled, unless the pass was made for views or samples; level 0 with
 * width x height texels is read, through the pass's own samplers. The pass remembers the last four sets of
 * names, kinds and sizes here, and queries OpenGL when a set is new or comes back for the first time. */
typedef struct nook_gl_frame_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Pixels; the size of every texture here, which may not exceed the maximum of the pass. Required. */
  int32_t width, height;
  /* x, y, width and height in pixels of the part that `projection` fills. Nook reads and writes nothing
     outside it; all 0 (default): everything. */
  int32_t viewport[4];
  /* Required; depth_kind is NOOK_DEPTH_HARDWARE by default. */
  uint32_t depth_texture;
  nook_depth_kind depth_kind;
  /* Metres, for linear depth only: this depth and greater ones are sky, whose AO is exactly 1. 0 (default):
   * no depth is. Sky is also a depth that is not finite, or is not positive in a perspective, and the far
   * plane of hardware depth. */
  float sky_depth;
  /* For logarithmic depth: C in 1 / metres, > 0, default 1; n in metres, 0 or more, default 0; f in metres, >
   * n, required. */
  float depth_log_scale, depth_log_near, depth_log_far;
  /* 0 (default): the pass reconstructs normals from depth. */
  uint32_t normal_texture;
  /* The normal is normal_matrix * (texel * normal_scale + normal_bias), then normalised. Defaults 1 and 0;
   * normals that are stored as (n + 1) / 2 need 2 and -1. The pass reconstructs a normal that is shorter than
   * 0.001, in normalised integers 0.25: clear to n = 0. */
  float normal_scale, normal_bias;
  /* Column-major; it maps to view space. The identity by default. */
  float normal_matrix[9];
  /* Column-major; required. Perspective, off-centre, orthographic, reversed-depth, infinite or oblique. */
  float projection[16];
  /* From world space to view space, column-major: a rotation and a translation. The identity by default. The
   * world pass needs it. The screen pass with max_history_frames remembers it, and follows surfaces into the
   * next frame by it; set nook_nnao_frame_desc.reset after a cut. */
  float view[16];
  /* Only hardware depth uses it. Default NOOK_CLIP_SPACE_NEGATIVE_ONE_TO_ONE. */
  nook_clip_space clip_space;
  /* Default NOOK_GBUFFER_AO_NONE; all other values require the texture. */
  nook_gbuffer_ao gbuffer_ao;
  uint32_t gbuffer_ao_texture;
  /* Default NOOK_TARGET_OWN. */
  nook_target target;
  /* The OpenGL name of your texture or framebuffer. Pixel (x, y) of the frame is written to its pixel (x, y).
   * sRGB formats are written and multiplied in linear light. */
  uint32_t target_name;
  /* Default NOOK_BLEND_WRITE. */
  nook_blend blend;
  /* Set 1 if you created a texture or target anew under an old name since the last call. Default 0. */
  int32_t textures_changed;
  /* For passes with views: 16, 16 and 9 numbers for each view, in place of projection, view and
   * normal_matrix. NULL (default): all views have the frame's own matrix. */
  const float* view_projections;
  const float* view_matrices;
  const float* view_normal_matrices;
} nook_gl_frame_desc;
static inline nook_result nook_gl_frame_desc_init(nook_gl_frame_desc* desc) {
  return nook_desc_init(NOOK_DESC_GL_FRAME, desc, sizeof *desc, NOOK_VERSION);
}

/* ---- Uploads: probes, materials and clips in shaders ----
 *
 * An upload is a probe, a grid, a material or baked clips as textures, with the GLSL that reads them. Upload
 * once. Put the GLSL of nook_gl_upload_describe after the #version line of your shader. Before a draw, call
 * nook_gl_upload_bind with your program. */

/* One texture of an upload. */
typedef struct nook_gl_upload_texture {
  /* The target to bind it to: GL_TEXTURE_BUFFER, GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY or GL_TEXTURE_3D. */
  uint32_t target;
  /* A texture that Nook owns. Bind it, but never change or delete it. */
  uint32_t texture;
  /* The name of its sampler in the GLSL; it is valid while the upload lives. */
  const char* uniform;
} nook_gl_upload_texture;

typedef struct nook_gl_upload_info {
  uint32_t struct_size;
  /* The number of textures, and of the texture units that a draw needs; at most 16. */
  uint32_t texture_count;
  nook_gl_upload_texture textures[16];
  /* The memory of all textures. On OpenGL ES, tables of texels are textures with rows of 2048 texels. */
  uint64_t bytes;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions, valid until the next update of the upload,
   * or its end. Every name in it, here and in all GLSL of Nook, begins with nook_, Nook or NOOK_. */
  const char* glsl;
  /* A uniform of constants, or NULL. A grid has nook_grid_frame, clips have nook_clip_vec4s. */
  const char* constant;
  /* Its values: constant_vec4s times four floats for glUniform4fv, or if that is 0 one integer, for
   * glUniform1i. */
  float constant_values[16];
  uint32_t constant_vec4s;
  /* 1: walls choose among the probes of a grid. */
  int32_t walls;
} nook_gl_upload_info;

/* Describes an upload, for your shaders and for hosts that bind textures themselves, without an OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_upload_describe(nook_gl_upload upload, nook_gl_upload_info* info);

/* Prepares a draw with program. Binds the textures to the texture units from first_unit on, without sampler
 * objects, and sets the sampler uniforms and the constants of the program. In every nook_gl_state_mode the
 * program stays in use and the textures stay bound; the active unit is treated as state_mode says. A sampler
 * that your shader does not use may be missing. If all are missing, the call fails and changes nothing; the
 * message names what the program was compiled for.
 * Context thread. Errors: INVALID_ARGUMENT (program is not a linked program, was compiled with the GLSL of
 * another kind of upload, or first_unit + texture_count exceeds GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS), GL. */
NOOK_API nook_result nook_gl_upload_bind(nook_gl_upload upload, uint32_t program, uint32_t first_unit);

/* Deletes the OpenGL objects and sets *upload to NULL; *upload may be NULL. You may destroy the nook_gl
 * before, but its OpenGL context must be current; after nook_gl_context_lost none is needed. Context
 * thread. */
NOOK_API void nook_gl_upload_destroy(nook_gl_upload* upload);

/* ---- Probes in shaders ----
 *
 * Form LOBES keeps the lobes of a probe or a grid in a table of texels, with the sampler nook_probe_texels.
 * Your shader:
 *     NookProbeSurface surface =
 *         NookProbeSurface(normal_ws, view_ws, tangent_ws, vec2(alpha_x, alpha_y), reflectance);
 *     NookProbePlace place = nook_probe_place(position_ws);  // once: the probes around a point
 *     vec3 e = nook_probe_irradiance(place, normal_ws);
 *     colour = nook_probe_ambient(albedo, e, vec3(ao));  // or directional occlusion instead of ao
 *     colour += nook_probe_specular_anisotropic(place, surface) *
 *               nook_probe_specular_occlusion(ao, n_dot_v, roughness);
 * For a single lobe, such as one in a uniform block, call nook_sg_lobe_radiance, nook_sg_lobe_irradiance and
 * so on; shaders/probe documents them. NookLobe has the layout of nook_lobe in std140 and std430. The GLSL
 * agrees with nook_probe.h within 1e-4 of the largest value, and is the same for every probe. Forms SH and
 * ZH3 keep a grid of diffuse light in a 3D texture of GL_RGBA16F, which the hardware filters. They take 7
 * fetches per pixel, 4 for ZH3, at most 40 where walls choose among ZH3 probes. They are smaller and faster
 * than lobes. The sampler is nook_grid_texels, the constant nook_grid_frame. Your shader:
 *     vec3 e = nook_grid_irradiance(position_ws, normal_ws);
 * experimental/nook_capture.h fills them from cube maps that your engine renders, while the game runs. */

/* The numbers that an upload holds for each probe. */
enum {
  /* Bands 0 to 2 of spherical harmonics, 27 half floats. */
  NOOK_GL_PROBE_SH = 0,
  /* ZH3, see nook_sh_to_zh3 of experimental/nook_sg.h; 15 half floats. */
  NOOK_GL_PROBE_ZH3 = 1,
  /* The lobes of the probe, four floats each. */
  NOOK_GL_PROBE_LOBES = 2
};
typedef int32_t nook_gl_probe_form;

/* Uploads a probe or a grid in a form, with its walls if it was baked with them and the form is not LOBES.
 * You may destroy the probe afterwards. For SH and ZH3, lobes are projected exactly, and bands above 2 are
 * left out. On failure *out is NULL and no OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT (LOBES: the basis of the probe is not NOOK_PROBE_BASIS_LOBES; SH
 * and ZH3: the probe is of ambient dice, or a coefficient is above 65504), UNSUPPORTED (LOBES: the probe
 * exceeds the texture buffer of this OpenGL, as it takes 3 + lobes * (1 + probes) texels, and every OpenGL
 * has 65,536; SH and ZH3: the texture has counts x by counts y by 7 counts z texels, as ZH3 4 counts z, with
 * walls 5 counts z more, and one of these is above GL_MAX_3D_TEXTURE_SIZE, which is 256 or more), GL,
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_probe(nook_gl gl, nook_probe probe, nook_gl_probe_form form,
                                          nook_gl_upload* out);

/* Uploads another probe or grid in place of the present one, in the form that the upload has. The textures
 * keep their names. Draws that were issued before still read the old values. The constant changes with the
 * box of a grid, and the GLSL if only one of both has walls. On failure the old probe stays.
 * Context thread. Errors: those of nook_gl_upload_probe, INVALID_ARGUMENT (the upload is not a probe). */
NOOK_API nook_result nook_gl_update_probe(nook_gl_upload upload, nook_probe probe);

/* ---- Materials in shaders ----
 *
 * Put the GLSL after the #version line of your fragment shader. For each light, which includes the cosine:
 *     vec4 modes[NOOK_LIGHT_VEC4_COUNT];
 *     nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);
 *     colour = nook_material_radiance(modes, light) * irradiance;
 *     alpha = nook_material_visibility(nook_material_occlusion(uv, dFdx(uv), dFdy(uv), view));
 * Both filter a pixel by one fetch of each mode at the mipmap level of its longer side, which blurs grazing
 * views. With several fetches along that side, `fetches` being a constant of 1 to NOOK_MATERIAL_MAX_FETCHES,
 * these stay sharp (see nook_material_evaluate):
 *     nook_material_decode_anisotropic(uv, dFdx(uv), dFdy(uv), view, fetches, modes);
 *     alpha = nook_material_visibility(
 *         nook_material_occlusion_anisotropic(uv, dFdx(uv), dFdy(uv), view, fetches));
 * Each fetch beyond the first costs further_decode_fetches of nook_material_info. The `modes` of a neural
 * material are sums of its network for the pixel: you cannot add them up or mix them.
 * Silhouettes of the meso-structure need two passes over the same triangles. The first draws pixels with
 * alpha = 1 and discards the others. The second blends those with 0 < alpha < 1 by alpha; it tests depth but
 * does not write it. */

/* Uploads a material, which you may destroy afterwards, as GL_TEXTURE_2D_ARRAYs. Materials of the same sizes
 * and mapping have the same GLSL and may share a program; a neural material has its own. The uniform vec2
 * nook_visibility_mapping, a constant on OpenGL ES, holds threshold and weight and starts with the
 * material's. On failure *out is NULL and no OpenGL object is left. Context thread. Errors: INVALID_ARGUMENT,
 * UNSUPPORTED (the material needs more texture units or larger textures than this OpenGL has, or blocks that
 * it does not have), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_upload_material(nook_gl gl, nook_material material, nook_gl_upload* out);

/* ---- Clips in shaders ----
 *
 * The AO of baked clips (nook_clips.h), decoded in your vertex shader. nook_clips_frames gives the frames and
 * their share for each character; pass both as uniforms or as attributes of the instance. Your shader:
 *     float ao = nook_clip_ao(gl_VertexID, frames, share);
 * The first argument is the number of a file vertex; where gl_VertexID counts other vertices, pass the number
 * as an attribute. The shader reads mode_count / 4 texels of the modes, and twice as many of the weights,
 * which are the same for all vertices of a character. */

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
