// Lines of GLSL with numbers in them.
#pragma once

#include <cstdarg>
#include <cstdio>

#include "sdk/src/core/compiler.h"
#include "sdk/src/core/containers.h"

namespace nook::gl {

// Appends up to 199 characters of printf's format.
inline void add(String& out, const char* format, ...) NOOK_PRINTF(2, 3);
inline void add(String& out, const char* format, ...) {
  char line[200];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  out += line;
}

}  // namespace nook::gl
