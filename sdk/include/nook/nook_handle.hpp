// The common part of the C++17 wrappers: failed calls throw nook::Error, and handles destroy their objects.
// The wrappers are header-only, so no C++ type is passed into or out of the library. The C headers document
// every function and its thread contract.
#ifndef NOOK_HANDLE_HPP
#define NOOK_HANDLE_HPP

// The C++ standard defines the macro __cpp_exceptions; Visual C++ defines _CPPUNWIND.
#if !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#error "Nook's .hpp headers throw exceptions, which are off here: call the C headers (nook.h) or turn them on"
#endif

#include <stdexcept>
#include <utility>

#include "nook.h"

namespace nook {
// The inline namespace avoids conflicts with the library's own names at link time. You still write
// nook::Scene.
inline namespace wrapper {

// A failed call. what() returns the text of nook_last_message(), or of nook_bake_last_message() if a function
// of the bakers failed.
class Error : public std::runtime_error {
 public:
  explicit Error(nook_result result) : Error(result, nook_last_message()) {}
  Error(nook_result result, const char* message) : std::runtime_error(message), result_(result) {}
  nook_result result() const noexcept { return result_; }

 private:
  nook_result result_;
};

// Throws Error unless the call succeeded.
inline void check(nook_result result) {
  if (result != NOOK_OK) throw Error(result);
}

// Owns one handle. Pass get() to the C functions.
template <class Handle, void (*destroy)(Handle*)>
class Unique {
 public:
  Unique() = default;
  explicit Unique(Handle handle) noexcept : handle_(handle) {}
  Unique(Unique&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Unique& operator=(Unique&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Unique() { destroy(&handle_); }

  Handle get() const noexcept { return handle_; }
  explicit operator bool() const noexcept { return handle_ != nullptr; }

 private:
  Handle handle_ = nullptr;
};

inline nook_context_desc context_desc() {
  nook_context_desc desc;
  check(nook_context_desc_init(&desc));
  return desc;
}

class Context : public Unique<nook_context, nook_context_destroy> {
 public:
  explicit Context(const nook_context_desc& desc = context_desc()) : Unique(create(desc)) {}

 private:
  static nook_context create(const nook_context_desc& desc) {
    nook_context handle = nullptr;
    check(nook_context_create(&desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
