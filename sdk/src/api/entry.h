// Every C function that can fail runs its body through this header, which converts an exception to a result
// code and to the last message of this thread.
#pragma once

#include <nook/nook.h>

#include <new>
#include <stdexcept>
#include <utility>

#include "sdk/src/core/failure.h"

namespace nook::api {

// Stores "function: text" as this thread's last message and returns the code.
nook_result fail(const char* function, nook_result code, const char* text) noexcept;

template <class Body>
nook_result enter(const char* function, Body&& body) noexcept {
  try {
    std::forward<Body>(body)();
    return NOOK_OK;
  } catch (const Failure& failure) {
    return fail(function, failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(function, NOOK_ERROR_OUT_OF_MEMORY,
                "the allocator returned NULL; free memory and call again");
  } catch (const std::length_error&) {
    return fail(function, NOOK_ERROR_OUT_OF_MEMORY,
                "more memory is needed than can be addressed; use smaller data");
  } catch (const std::exception& e) {
    return fail(function, NOOK_ERROR_INTERNAL, e.what());
  } catch (...) {
    return fail(function, NOOK_ERROR_INTERNAL, "an unknown exception; please report it");
  }
}

}  // namespace nook::api
