#include "sdk/src/core/context.h"

#include <cstdarg>
#include <cstdio>

namespace nook {

void Context::log(nook_log_severity severity, const char* format, ...) const noexcept {
  if (!log_) return;
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  log_(log_user_, severity, text);
}

}  // namespace nook
