#include "sdk/src/core/failure.h"

#include <cstdarg>
#include <cstdio>

namespace nook {

Failure::Failure(nook_result code, const char* format, ...) noexcept : code_(code) {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text_, sizeof text_, format, arguments);
  va_end(arguments);
}

}  // namespace nook
