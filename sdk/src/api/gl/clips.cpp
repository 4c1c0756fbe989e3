#include <nook/nook_gl_clips.h>

#include "sdk/src/gl/program.h"

const char* nook_gl_clips_glsl(void) {
  return nook::gl::embedded_text("clips/host.glsl");
}
