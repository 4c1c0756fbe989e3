/* An OpenGL context without a display, and what a small program needs of it. */
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

/* Makes an OpenGL 3.3 core context current by EGL without a surface. 0: failed, and a line on stderr says
 * why. */
int offscreen_start(void);
void offscreen_stop(void);

/* For nook_gl_desc.get_proc. */
void* offscreen_proc(void* user, const char* name);

/* 0: failed, and the compiler's words are on stderr. */
GLuint offscreen_program(const char* vertex_text, const char* fragment_text);
/* A texture without mipmaps, such as (GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE). */
GLuint offscreen_texture(GLint internal_format, GLenum format, GLenum type, int width, int height);
/* Either texture may be 0. 0: not complete. */
GLuint offscreen_framebuffer(GLuint colour, GLuint depth);

#endif
