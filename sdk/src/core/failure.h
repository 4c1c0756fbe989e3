// The error that travels inside the library; the api rooms turn it into a nook_result and a message.
#pragma once

#include <nook/nook.h>

#include <exception>

namespace nook {

class Failure : public std::exception {
 public:
  // printf-style; the text says what is wrong, what came and what is needed, without the function's name,
  // which the api adds. It is cut at the buffer's end: throwing allocates nothing.
  Failure(nook_result code, const char* format, ...) noexcept __attribute__((format(printf, 3, 4)));

  nook_result code() const noexcept { return code_; }
  const char* what() const noexcept override { return text_; }

 private:
  nook_result code_;
  char text_[480];
};

// Throws INVALID_ARGUMENT unless the pointer is there.
inline void need(const void* pointer, const char* name) {
  if (!pointer)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is NULL; a valid pointer or handle is needed", name);
}

}  // namespace nook
