/* The frame of main.c for an engine that has OpenGL 3.3 or newer: the result stays on the GPU.
 *
 * The OpenGL functions come in as pointers because this file includes no loader. An engine calls the
 * functions of its own loader. */
#include "samples/minimal/minimal_gl.h"

/* ---- 1. Once for each OpenGL context ---- */
nook_result minimal_gl_start(nook_context context, nook_gl_proc_fn get_proc, void* user, nook_gl* gl) {
  nook_gl_desc desc;
  nook_result r = nook_gl_desc_init(&desc);
  if (r) return r;
  desc.get_proc = get_proc; /* for example a wrapper of glfwGetProcAddress */
  desc.get_proc_user = user;
  return nook_gl_create(context, &desc, gl);
}

/* ---- 2. Each frame, after nook_scene_set_pose as in main.c ---- */
nook_result minimal_gl_frame(nook_gl gl, nook_scene scene) {
  return nook_gl_scene_update(gl, scene); /* instead of nook_scene_update */
}

/* ---- 3. For each character that is drawn: one float attribute ----
 *
 *   layout(location = SLOT) in float ao;      // vertex shader, passed on to the fragment shader
 *   colour = albedo * (ambient * ao + direct);
 */
nook_result minimal_gl_bind(nook_gl gl, nook_scene scene, nook_instance_id instance,
                            const minimal_gl_calls* call, unsigned slot) {
  enum { ARRAY_BUFFER = 0x8892, FLOAT = 0x1406 };
  nook_gl_view view = {0};
  nook_result r;
  view.struct_size = sizeof view;
  r = nook_gl_scene_view(gl, scene, instance, NOOK_CHANNEL_AO, &view);
  if (r) return r;
  call->bind_buffer(ARRAY_BUFFER, view.buffer);
  call->enable_vertex_attrib_array(slot);
  call->vertex_attrib_pointer(slot, 1, FLOAT, 0, (int)view.stride, (const void*)(uintptr_t)view.offset);
  return NOOK_OK;
}
