// Reads and sets single pieces of OpenGL state for the guard.
#pragma once

#include "sdk/src/gl/functions.h"

namespace nook::gl {

inline GLint integer(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

inline void set_enabled(const Functions& gl, GLenum capability, bool enabled) {
  enabled ? gl.Enable(capability) : gl.Disable(capability);
}

}  // namespace nook::gl
