/* The OpenGL functions: characters evaluated on the GPU, with their ambient occlusion in buffers that the
 * host's shaders read.
 *
 * Nook needs OpenGL 3.3 core, OpenGL ES 3.0 or WebGL 2, or newer, and includes no OpenGL header. There are
 * two ways. Tiers 43 and ES31: on OpenGL 4.3 and OpenGL ES 3.1, spheres, shadows and vertices are evaluated
 * in compute shaders. Tiers 33 and ES30: on OpenGL 3.3, OpenGL ES 3.0 and WebGL 2, shadows at key points are
 * evaluated on the CPU, through the context's parallel_for, and vertices by transform feedback. On software
 * renderers such as Mesa's llvmpipe this way is faster; max_tier selects it. "Texture buffer" below means a
 * GL_TEXTURE_BUFFER on OpenGL, and a GL_TEXTURE_2D on OpenGL ES and WebGL, where Nook's GLSL text declares
 * its sampler accordingly. WebGL has no glGetTexLevelParameteriv and stalls at reads: NOOK_GL_STATE_DEFAULTS
 * is the mode for it.
 *
 * An engine creates one nook_gl for each OpenGL context that shares nothing with another. Once a frame, after
 * it has set the poses, it calls nook_gl_scene_update. For each character it binds the view of
 * nook_gl_scene_ao_buffer as a vertex attribute, and its shader multiplies the ambient term (not the direct
 * light) of the material by it:
 *     glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
 *     glVertexAttribPointer(slot, 1, GL_FLOAT, GL_FALSE, view.stride, (const void*)(uintptr_t)view.offset);
 * The i-th value belongs to the i-th vertex of the imported file, the primitives one after another;
 * nook_character_model_primitive gives the first value of a primitive.
 *
 * At each call, no transform feedback may be active unless it is paused, and neither conditional rendering
 * nor a query that counts primitives or samples may be active. Calls that allocate report OpenGL errors that
 * the host left to the log; the other calls neither read nor clear them. Functions make OpenGL calls unless
 * their comment says otherwise. */
#ifndef NOOK_GL_H
#define NOOK_GL_H

#include "nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_s* nook_gl;

/* The host's loader: returns the address of the OpenGL function called name, or NULL. Nook calls it only
 * inside nook_gl_create. */
typedef void* (*nook_gl_proc_fn)(void* user, const char* name);

/* The tiers, as max_tier and nook_gl_info have them. The other tier of the same kind counts as its like: 33
 * and ES30 forbid compute shaders, 43 and ES31 allow them. */
enum {
  NOOK_GL_TIER_BEST = 0,
  /* OpenGL 3.3 core: transform feedback, texture buffers. */
  NOOK_GL_TIER_33 = 33,
  /* OpenGL 4.3 core: compute shaders with shader storage. */
  NOOK_GL_TIER_43 = 43,
  /* OpenGL ES 3.0 and WebGL 2: transform feedback, 2D textures in place of texture buffers. */
  NOOK_GL_TIER_ES30 = 300,
  /* OpenGL ES 3.1 and 3.2: compute shaders with at most four storage blocks, as every such context has. */
  NOOK_GL_TIER_ES31 = 310
};
typedef int32_t nook_gl_tier;

/* The treatment of the OpenGL state that Nook touches; docs/gl_state.md lists all of it. */
enum {
  /* Each call queries the state and restores it. A query may stall a threaded driver. */
  NOOK_GL_STATE_PRESERVE = 0,
  /* Nook reads no state, and leaves what it touched at OpenGL's defaults. */
  NOOK_GL_STATE_DEFAULTS = 1,
  /* Nook reads no state, and leaves what it touched undefined, so that the host must set it again. Rasterizer
   * discard and primitive restart are left disabled. */
  NOOK_GL_STATE_HOST = 2
};
typedef int32_t nook_gl_state_mode;

typedef struct nook_gl_desc {
  /* nook_gl_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Required. */
  nook_gl_proc_fn get_proc;
  /* The first argument of get_proc. */
  void* get_proc_user;
  /* The highest tier to use; default NOOK_GL_TIER_BEST, the best one of the OpenGL context. */
  nook_gl_tier max_tier;
  /* Default NOOK_GL_STATE_PRESERVE. */
  nook_gl_state_mode state_mode;
} nook_gl_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. The call makes no OpenGL call.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_gl_desc_init(nook_gl_desc* desc, size_t size, uint32_t header_version);

/* Loads functions and compiles shaders for the OpenGL context that is current. Host memory comes from the
 * context's allocator, except for one small allocation of the function loader. On failure *out is NULL and no
 * OpenGL object is left.
 * Context thread. Errors: INVALID_ARGUMENT, VERSION, UNSUPPORTED (the message names the OpenGL version or the
 * missing function), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_create(nook_context context, const nook_gl_desc* desc, nook_gl* out);

/* Deletes every OpenGL object that gl created and sets *gl to NULL; *gl may be NULL. The context and the
 * scenes may have been destroyed before. After nook_gl_context_lost the call needs no OpenGL context.
 * Context thread. */
NOOK_API void nook_gl_destroy(nook_gl* gl);

/* Tells Nook that the OpenGL context is gone: gl forgets all OpenGL names without an OpenGL call. Afterwards
 * nook_gl_describe and nook_gl_destroy still work, and functions that need the OpenGL context fail with
 * NOOK_ERROR_GL.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_context_lost(nook_gl gl);

typedef struct nook_gl_info {
  /* sizeof(nook_gl_info); the caller sets it. */
  uint32_t struct_size;
  nook_gl_tier tier;
  /* GL_VERSION and GL_RENDERER of the OpenGL context; both are valid while gl lives. */
  const char* version;
  const char* renderer;
  /* The OpenGL buffer memory that gl holds now: models, working space and AO. */
  uint64_t buffer_bytes;
  /* The part of buffer_bytes that holds AO. */
  uint64_t ao_bytes;
} nook_gl_info;

/* Describes gl. The call makes no OpenGL call.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_describe(nook_gl gl, nook_gl_info* info);

/* The OpenGL memory of a model, in bytes, as nook_gl_info.buffer_bytes counts it. */
typedef struct nook_gl_memory {
  /* sizeof(nook_gl_memory); the caller sets it. */
  uint32_t struct_size;
  uint32_t reserved;
  /* The bytes that all instances of the model share. */
  uint64_t model_bytes;
  /* The bytes of one instance, without links. */
  uint64_t instance_bytes;
  /* The same with a light. */
  uint64_t lit_instance_bytes;
} nook_gl_memory;

/* Computes the OpenGL memory of a model before any of it is used; buffers that grow have up to half as much
 * again. The call makes no OpenGL call. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_model_memory(nook_gl gl, nook_character_model model, nook_gl_memory* memory);

/* Creates the OpenGL objects that the scene's instances need, so that the next nook_gl_scene_update allocates
 * nothing. The call is optional, because an update does the same when instances were added. Existing
 * instances keep their AO and their view.
 * Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (a model or the scene exceeds a limit of this
 * OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_prepare(nook_gl gl, nook_scene scene);

/* Evaluates the AO of all instances on the GPU. It evaluates everything that nook_scene_update evaluates and
 * replaces it: a host calls one of the two in a frame. The values agree with nook_scene_read_ao within 2e-3,
 * beside what far_error of the scene changes there.
 * The call allocates host memory only if instances were added, received their first light or have more lobes
 * than the lights had room for since the last prepare or update, and it never waits for the GPU. No other
 * call may use the scene meanwhile. Context thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (as
 * nook_gl_scene_prepare; also, the lights exceed the texture buffer of this OpenGL: each takes 12 + 2 * lobes
 * texels, and every OpenGL has 65,536), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_update(nook_gl gl, nook_scene scene);

/* The place of an instance's AO in an OpenGL buffer: count floats in [0, 1]. */
typedef struct nook_gl_ao_view {
  /* sizeof(nook_gl_ao_view); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of a buffer that Nook owns: the host reads it, and never writes or deletes it. */
  uint32_t buffer;
  /* Bytes from the start of the buffer to the first value. */
  uint64_t offset;
  /* Bytes between the starts of two values. */
  uint32_t stride;
  /* The model's file_vertex_count. */
  uint32_t count;
} nook_gl_ao_view;

/* Gives the view of an instance, which stays the same until the instance, the scene or gl is destroyed,
 * nook_gl_scene_release is called, or nook_scene_set_model gives the instance another model. The values are 1
 * before the first update. After an update they may be read as vertex attributes, texture buffers, shader
 * storage and by buffer reads without a barrier of the host. The call makes no OpenGL call.
 * Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (the id is unknown, or the instance is not
 * prepared yet), GL. */
NOOK_API nook_result nook_gl_scene_ao_buffer(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                             nook_gl_ao_view* view);

/* Where nook_gl_scene_write_ao puts AO: a buffer or a texture of the host. */
typedef struct nook_gl_ao_target {
  /* sizeof(nook_gl_ao_target); the caller sets it, and the other fields to 0 first. */
  uint32_t struct_size;
  /* The numbers in a buffer. A texture's own format decides instead; but on OpenGL ES, where uploads do not
   * convert, this must be the texture's: NOOK_AO_FLOAT for GL_R32F, NOOK_AO_HALF for GL_R16F, NOOK_AO_UNORM8
   * for GL_R8. */
  nook_ao_format format;
  /* The OpenGL name of a buffer of the host, or 0. It must not be mapped. */
  uint32_t buffer;
  /* The OpenGL name of a GL_TEXTURE_2D of the host with a format that has a red channel of floats or of
   * normalised integers, such as GL_R8, or 0. The value of vertex i goes to texel i, row by row. */
  uint32_t texture;
  /* Of the first value: bytes, a multiple of 4, or texels. */
  uint64_t offset;
  /* From the values of one instance to those of the next: bytes, a multiple of 4, or texels; so that one
   * instanced or indirect draw reads all instances. Only with count > 1. */
  uint64_t instance_stride;
  /* Bytes between the starts of two values in a buffer, a multiple of 4, for AO among other attributes of a
   * vertex; a value then owns a whole word. Needs compute shaders. 0: tightly packed; the bytes of an
   * instance are rounded up to a multiple of 4, and the bytes of the padding are written. */
  uint32_t stride;
  /* The width of the texture in texels. Needed on OpenGL ES 3.0 and WebGL 2, which do not tell it;
   * elsewhere 0 has it looked up. */
  uint32_t texture_width;
} nook_gl_ao_target;

/* Copies the AO of the last nook_gl_scene_update to a buffer or texture of the host on the GPU, for count
 * instances one after another. Vertices, texture fetches and buffer reads see the values without a barrier of
 * the host. The call does not wait for the GPU. The first call with a format makes a program.
 * Context thread. Errors: INVALID_ARGUMENT (also: the target is too small), INVALID_HANDLE (an id is unknown,
 * or an instance is not prepared yet), UNSUPPORTED (a stride without compute shaders), GL. */
NOOK_API nook_result nook_gl_scene_write_ao(nook_gl gl, nook_scene scene, const nook_instance_id* instances,
                                            uint32_t count, const nook_gl_ao_target* target);

/* Copies the AO of the last update to host memory in the order of nook_scene_read_ao. The call WAITS FOR THE
 * GPU and is meant for tests and tools.
 * Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (the id is unknown, or the instance is not
 * prepared yet), GL. */
NOOK_API nook_result nook_gl_scene_read_ao(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                           float* out, uint32_t count);

/* ---- Directional occlusion: nook_scene_set_light, evaluated for each vertex on the GPU ----
 *
 * For each instance with a light, nook_gl_scene_update leaves its directional occlusion beside its AO: a
 * colour for each vertex that takes the place of AO. The lobes of all lights lie in a texture buffer that
 * Nook owns, so that the host uploads nothing. The host puts the view's glsl after the #version line of a
 * vertex or fragment shader, sets the uniform nook_scene_lights to a texture unit, and binds the texture to
 * GL_TEXTURE_BUFFER of that unit, on OpenGL ES to GL_TEXTURE_2D. For each draw it sets the values as an
 * attribute and view.light as a uniform:
 *     glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
 *     glVertexAttribPointer(slot, 3, GL_FLOAT, GL_FALSE, view.stride, (const void*)(uintptr_t)view.offset);
 * In the shader, n is the unit normal in world space:
 *     vec3 e = nook_scene_irradiance(light, n, directional_ao);
 *     colour = albedo / 3.14159265 * e;
 * nook_scene_open_irradiance(light, n) is the irradiance without occlusion. A shader may hold this text and
 * that of nook_gl_probe_describe, in either order. Every name in it begins with nook_ or Nook. */
typedef struct nook_gl_light_view {
  /* sizeof(nook_gl_light_view); the caller sets it. */
  uint32_t struct_size;
  /* The OpenGL name of a buffer that Nook owns: the host reads it, and never writes or deletes it. */
  uint32_t buffer;
  /* Bytes from the start of the buffer to the first value, which is three floats (red, green, blue) in
   * [0, 1]. */
  uint64_t offset;
  /* Bytes between the starts of two values. */
  uint32_t stride;
  /* The model's file_vertex_count. */
  uint32_t count;
  /* The OpenGL name of a GL_TEXTURE_BUFFER (OpenGL ES: GL_TEXTURE_2D) that Nook owns, the same for all
   * instances of the scene. */
  uint32_t texture;
  /* The first argument of the GLSL functions; it is valid until the next update. */
  int32_t light;
  /* GLSL 3.30, also GLSL ES 3.00, without #version and precisions: the uniform samplerBuffer (OpenGL ES:
   * sampler2D) nook_scene_lights and the functions above. The text is the same for every scene and valid as
   * long as the library is loaded. */
  const char* glsl;
} nook_gl_light_view;

/* Gives the view of an instance that had a light in the last nook_gl_scene_update. buffer, offset and texture
 * stay the same as long as the view of nook_gl_scene_ao_buffer. The values agree with
 * nook_scene_read_directional_ao within 4e-3, because each term takes two estimates of a square root. They
 * are ordered as AO is, and need no barrier of the host. The call makes no OpenGL call.
 * Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (the id is unknown, or the instance had no light
 * in the last update), GL. */
NOOK_API nook_result nook_gl_scene_light(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                         nook_gl_light_view* view);

/* Copies the directional occlusion of the last update to host memory, three floats for each vertex; count is
 * in vertices. The call WAITS FOR THE GPU and is meant for tests and tools.
 * Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (the id is unknown, or the instance had no light
 * in the last update), GL. */
NOOK_API nook_result nook_gl_scene_read_directional_ao(nook_gl gl, nook_scene scene,
                                                       nook_instance_id instance, float* out_rgb,
                                                       uint32_t count);

/* Deletes the OpenGL objects that gl holds for a scene, which ends the views of its instances; the scene
 * itself lives on. Without this call the next update, or nook_gl_destroy, deletes the objects of a destroyed
 * scene.
 * Context thread. Errors: INVALID_ARGUMENT, GL. */
NOOK_API nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene);

#ifdef __cplusplus
}
#endif
#endif
