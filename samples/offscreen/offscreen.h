/* An OpenGL context without a display, and the few objects that a small program makes with it. */
#ifndef OFFSCREEN_H
#define OFFSCREEN_H

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

/* Makes an OpenGL 3.3 core context current, through EGL without a surface. Returns 0 on failure and prints
 * the reason to stderr. */
int offscreen_start(void);
void offscreen_stop(void);

/* The value for nook_gl_desc.get_proc. */
void* offscreen_proc(void* user, const char* name);

/* Returns 0 on failure and prints the compiler's message to stderr. */
GLuint offscreen_program(const char* vertex_text, const char* fragment_text);
/* Makes a texture without mipmaps, for example of (GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE). */
GLuint offscreen_texture(GLint internal_format, GLenum format, GLenum type, int width, int height);
/* Either texture may be 0. Returns 0 if the framebuffer is not complete. */
GLuint offscreen_framebuffer(GLuint colour, GLuint depth);

#endif
