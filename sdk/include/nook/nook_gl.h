/* The OpenGL door: characters evaluated on the GPU, their ambient occlusion left in buffers that a host's shader reads.
 *
 * Needs OpenGL 3.3 core or newer; includes no OpenGL header. Two tiers:
 *   43  OpenGL 4.3: spheres, shadows and vertices in compute shaders;
 *   33  OpenGL 3.3: shadows at key points on the CPU (through the context's parallel_for), vertices by transform feedback.
 *       Faster than 43 on software renderers such as Mesa's llvmpipe; ask for it with max_tier.
 *
 * In an engine: create one nook_gl for each OpenGL context that shares nothing; once a frame, after the poses are set, call
 * nook_gl_scene_update; for each character bind the view of nook_gl_scene_ao_buffer as a vertex attribute and multiply
 * the ambient term (not the direct light) of the material with it:
 *     glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
 *     glVertexAttribPointer(slot, 1, GL_FLOAT, GL_FALSE, view.stride, (const void*)(uintptr_t)view.offset);
 * The i-th value belongs to the i-th vertex of the imported file, all primitives in a row; the first value of a primitive is
 * at nook_character_model_primitive.
 *
 * Every function here except nook_gl_desc_init, nook_gl_context_lost and nook_gl_describe belongs to the context thread, and
 * makes OpenGL calls unless it says otherwise. At each call no transform feedback without pause, no conditional rendering and no query that counts
 * primitives or samples may be active. OpenGL errors that the host left are reported to the log by calls that allocate;
 * the others neither read nor clear them. */
#ifndef NOOK_GL_H
#define NOOK_GL_H

#include "nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_gl_s* nook_gl;

/* The host's loader: the address of the OpenGL function called name, or NULL. Called only inside nook_gl_create. */
typedef void* (*nook_gl_proc_fn)(void* user, const char* name);

/* What happens to the OpenGL state that Nook touches; docs/gl_state.md lists all of it. */
enum {
  NOOK_GL_STATE_PRESERVE = 0, /* query once a call, put everything back; a query may stall a threaded driver */
  NOOK_GL_STATE_DEFAULTS = 1, /* reads no state; leaves what it touched at OpenGL's defaults */
  NOOK_GL_STATE_HOST = 2      /* reads no state; leaves what it touched as it happens to be; the host sets it anew.
                                 Rasterizer discard and primitive restart are left disabled */
};
typedef int32_t nook_gl_state_mode;

typedef struct nook_gl_desc {
  uint32_t struct_size;          /* set by nook_gl_desc_init */
  uint32_t header_version;       /* set by nook_gl_desc_init */
  const void* next;              /* NULL */
  nook_gl_proc_fn get_proc;      /* required */
  void* get_proc_user;           /* passed back unchanged */
  int32_t max_tier;              /* 0: the best that the context has (default); 33 or 43: at most that */
  nook_gl_state_mode state_mode; /* default NOOK_GL_STATE_PRESERVE */
} nook_gl_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_gl_desc_init(nook_gl_desc* desc, size_t size, uint32_t header_version);

/* Loads functions and compiles shaders for the OpenGL context that is current. On failure *out is NULL and no OpenGL object
 * is left. All memory comes from the context's allocator. Context thread.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (names the version or the function that is missing), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_create(nook_context context, const nook_gl_desc* desc, nook_gl* out);

/* Deletes every OpenGL object it made and sets *gl to NULL; NULL is fine. The context and scenes may be gone before.
 * Context thread, with the OpenGL context of nook_gl_create current (any thread after nook_gl_context_lost). */
NOOK_API void nook_gl_destroy(nook_gl* gl);

/* Says that the OpenGL context is gone: forgets all names without an OpenGL call. Afterwards only nook_gl_describe and
 * nook_gl_destroy do anything; the others fail with NOOK_ERROR_GL. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_context_lost(nook_gl gl);

typedef struct nook_gl_info {
  uint32_t struct_size;     /* sizeof(nook_gl_info), set by the caller */
  int32_t tier;             /* 33 or 43 */
  const char* version;      /* GL_VERSION and GL_RENDERER of the OpenGL context; valid while gl lives */
  const char* renderer;
  uint64_t buffer_bytes;    /* OpenGL buffer memory held now: models, working space and AO */
  uint64_t ao_bytes;        /* of that, AO */
} nook_gl_info;
/* One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_describe(nook_gl gl, nook_gl_info* info);

/* Makes what the scene's instances need on the GPU, so that the next nook_gl_scene_update allocates nothing. Optional:
 * an update prepares when instances were added. Instances that were there keep their AO and their view. Context thread.
 * Errors: INVALID_ARGUMENT, UNSUPPORTED (a model or a crowd beyond the limits of this OpenGL), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_prepare(nook_gl gl, nook_scene scene);

/* Evaluates the AO of all instances, with everything that nook_scene_update evaluates, and instead of it: call one of
 * the two in a frame. Values agree with nook_scene_read_ao within 2e-3. Allocates no host memory unless instances were added, or
 * got their first light, since the last prepare or update; never waits for the GPU. Context thread, and one at a time for the
 * scene. Errors: INVALID_ARGUMENT, UNSUPPORTED (also: more lights than a texture buffer of this OpenGL holds, 12 + 2 * lobes texels
 * each, of which every OpenGL has 65,536), GL, OUT_OF_MEMORY. */
NOOK_API nook_result nook_gl_scene_update(nook_gl gl, nook_scene scene);

/* Where the AO of an instance lies: count floats in [0, 1], stride bytes apart. */
typedef struct nook_gl_ao_view {
  uint32_t struct_size; /* sizeof(nook_gl_ao_view), set by the caller */
  uint32_t buffer;      /* OpenGL buffer name; owned by Nook: read it, never write or delete it */
  uint64_t offset;      /* bytes to the first value */
  uint32_t stride;      /* bytes */
  uint32_t count;       /* the model's file_vertex_count */
} nook_gl_ao_view;

/* The view of an instance; it stays the same until the instance, the scene or gl is destroyed. The values are 1 before
 * the first update. Ordered for use as vertex attributes, texture buffers, shader storage and buffer reads. Makes
 * no OpenGL call. Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (also: not yet prepared). */
NOOK_API nook_result nook_gl_scene_ao_buffer(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                             nook_gl_ao_view* view);

/* Copies the AO of the last update to host memory, as nook_scene_read_ao does. WAITS FOR THE GPU: for tests and tools, not for
 * frames. Context thread. Errors: INVALID_ARGUMENT, INVALID_HANDLE (also: not yet prepared), GL. */
NOOK_API nook_result nook_gl_scene_read_ao(nook_gl gl, nook_scene scene, nook_instance_id instance, float* out,
                                           uint32_t count);

/* ---- Directional occlusion: nook_scene_set_light, by vertex on the GPU ----
 *
 * After nook_scene_set_light, nook_gl_scene_update leaves for each instance with a light, beside AO, its directional occlusion: a
 * colour for each vertex that takes the place of AO. The lobes of all lights lie in a texture buffer, so that the host's
 * shader needs no upload of its own. Put the view's glsl behind the #version line of a vertex or fragment shader, set the uniform
 * nook_scene_lights to the unit that the texture will be bound to, bind the texture to GL_TEXTURE_BUFFER of that unit, and for each draw
 * the values as an attribute and view.light as a uniform:
 *     glBindBuffer(GL_ARRAY_BUFFER, view.buffer);
 *     glVertexAttribPointer(slot, 3, GL_FLOAT, GL_FALSE, view.stride, (const void*)(uintptr_t)view.offset);
 * The shader, n the unit normal in world space:
 *     vec3 e = nook_scene_irradiance(light, n, directional_ao);   // nook_scene_open_irradiance(light, n) without occlusion
 *     colour = albedo / 3.14159265 * e;
 * The text goes with that of nook_gl_probe_describe into one shader, in either order. Every name begins with nook_ or Nook. */
typedef struct nook_gl_light_view {
  uint32_t struct_size; /* sizeof(nook_gl_light_view), set by the caller */
  uint32_t buffer;      /* OpenGL buffer name; owned by Nook: read it, never write or delete it */
  uint64_t offset;      /* bytes to the first value: red, green, blue, in [0, 1], floats */
  uint32_t stride;      /* bytes */
  uint32_t count;       /* the model's file_vertex_count */
  uint32_t texture;     /* OpenGL name of a GL_TEXTURE_BUFFER, the same for all instances of the scene; owned by Nook */
  int32_t light;        /* the first argument of the GLSL's functions; stays until the next update */
  const char* glsl;     /* GLSL 3.30 without #version: uniform samplerBuffer nook_scene_lights and the functions above, the
                           same text for every scene. Valid as long as the library is loaded */
} nook_gl_light_view;

/* The view of an instance whose light the last nook_gl_scene_update saw; buffer, offset and texture stay the same until the instance,
 * the scene or gl is destroyed. Values agree with nook_scene_read_directional_ao within 4e-3 (two roots of estimates in each term).
 * Ordered as AO is. Makes no OpenGL call. Context thread.
 * Errors: INVALID_ARGUMENT, INVALID_HANDLE (also: the last update saw no light). */
NOOK_API nook_result nook_gl_scene_light(nook_gl gl, nook_scene scene, nook_instance_id instance, nook_gl_light_view* view);

/* Copies the directional occlusion of the last update to host memory, three floats a vertex; count is in vertices. WAITS FOR THE
 * GPU: for tests and tools, not for frames. Context thread.
 * Errors: INVALID_ARGUMENT, INVALID_HANDLE (also: the last update saw no light), GL. */
NOOK_API nook_result nook_gl_scene_read_directional_ao(nook_gl gl, nook_scene scene, nook_instance_id instance, float* out_rgb,
                                                       uint32_t count);

/* Deletes what gl holds for a scene, before the scene itself or instead of it. Without it, the objects of a destroyed scene are
 * deleted by the next update or by nook_gl_destroy. Context thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene);

#ifdef __cplusplus
}
#endif
#endif
