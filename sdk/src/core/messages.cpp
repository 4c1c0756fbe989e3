#include <cstdarg>
#include <cstdio>

#include "sdk/src/core/context.h"
#include "sdk/src/core/failure.h"

namespace nook {

Failure::Failure(nook_result code, const char* format, ...) noexcept : code_(code) {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text_, sizeof text_, format, arguments);
  va_end(arguments);
}

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
