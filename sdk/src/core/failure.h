// The exception of the library. The C functions in the api folders convert it to a nook_result and a message.
#pragma once

#include <nook/nook.h>

#include <exception>

#include "sdk/src/core/compiler.h"

namespace nook {

class Failure : public std::exception {
 public:
  // Takes a printf-style text, which should say what is wrong, the value, and which values are allowed. The C
  // function that reports the failure adds its name to the text. The text is truncated to the size of the
  // buffer, so throwing does not allocate.
  Failure(nook_result code, const char* format, ...) noexcept NOOK_PRINTF(3, 4);

  nook_result code() const noexcept { return code_; }
  const char* what() const noexcept override { return text_; }

 private:
  nook_result code_;
  char text_[480];
};

// Throws INVALID_ARGUMENT if the pointer is null.
inline void need(const void* pointer, const char* name) {
  if (!pointer)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is NULL; a valid pointer or handle is needed", name);
}

}  // namespace nook
