#include "samples/offscreen/offscreen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdio.h>

static EGLDisplay display = EGL_NO_DISPLAY;
static EGLContext context = EGL_NO_CONTEXT;

static int fail(const char* what) {
  fprintf(stderr, "offscreen: %s (EGL error 0x%04x)\n", what, (unsigned)eglGetError());
  return 0;
}

int offscreen_start(void) {
  static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                      3,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      3,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_NONE};
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display;
  /* This is the one conversion from a data pointer to a function pointer that every C compiler accepts. */
  *(void**)(&platform_display) = (void*)eglGetProcAddress("eglGetPlatformDisplayEXT");
  if (!platform_display) return fail("EGL has no platform displays; install libegl1");
  display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, (void*)EGL_DEFAULT_DISPLAY, NULL);
  if (!display || !eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
    return fail("EGL has no display without a surface; install libgl1-mesa-dri");
  context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    return fail("EGL gives no OpenGL 3.3 core context");
  return 1;
}

void offscreen_stop(void) {
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
}

void* offscreen_proc(void* user, const char* name) {
  (void)user;
  return (void*)eglGetProcAddress(name);
}

static GLuint shader(GLenum stage, const char* text) {
  const GLuint name = glCreateShader(stage);
  GLint compiled = 0;
  char log[1000] = "";
  glShaderSource(name, 1, &text, NULL);
  glCompileShader(name);
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled) return name;
  glGetShaderInfoLog(name, sizeof log, NULL, log);
  fprintf(stderr, "offscreen: a shader does not compile: %s\n", log);
  glDeleteShader(name);
  return 0;
}

GLuint offscreen_program(const char* vertex_text, const char* fragment_text) {
  const GLuint vertex = shader(GL_VERTEX_SHADER, vertex_text),
               fragment = shader(GL_FRAGMENT_SHADER, fragment_text);
  GLuint program = glCreateProgram();
  GLint linked = 0;
  if (vertex && fragment) {
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
  }
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  if (linked) return program;
  glDeleteProgram(program);
  return 0;
}

GLuint offscreen_texture(GLint internal_format, GLenum format, GLenum type, int width, int height) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, internal_format, width, height, 0, format, type, NULL);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  return name;
}

GLuint offscreen_framebuffer(GLuint colour, GLuint depth) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  if (colour) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
  if (depth) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ? name : 0;
}
