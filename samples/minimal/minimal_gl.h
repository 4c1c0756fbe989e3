/* The functions of minimal_gl.c, and the three OpenGL functions that they call. */
#ifndef MINIMAL_GL_H
#define MINIMAL_GL_H

#include <nook/nook_gl.h>

typedef struct minimal_gl_calls {
  void (*bind_buffer)(unsigned target, unsigned buffer);
  void (*enable_vertex_attrib_array)(unsigned slot);
  void (*vertex_attrib_pointer)(unsigned slot, int size, unsigned type, unsigned char normalized, int stride,
                                const void* offset);
} minimal_gl_calls;

nook_result minimal_gl_start(nook_context context, nook_gl_proc_fn get_proc, void* user, nook_gl* gl);
nook_result minimal_gl_frame(nook_gl gl, nook_scene scene);
nook_result minimal_gl_bind(nook_gl gl, nook_scene scene, nook_instance_id instance,
                            const minimal_gl_calls* call, unsigned slot);

#endif
