// Every C function that can fail runs its body here; an exception becomes a result and this thread's message.
#pragma once

#include <nook/nook.h>

#include <exception>
#include <utility>

#include "core/failure.h"

namespace nook::bake::api {

struct Outcome {
  nook_result result = NOOK_OK;
  char text[480] = "";
};

// Returns the result and the message of an exception.
Outcome outcome_of(const std::exception_ptr& exception) noexcept;

// Stores "function: text" as this thread's last message and returns the code.
nook_result fail(const char* function, const Outcome& outcome) noexcept;

template <class Body>
nook_result enter(const char* function, Body&& body) noexcept {
  try {
    std::forward<Body>(body)();
    return NOOK_OK;
  } catch (...) {
    return fail(function, outcome_of(std::current_exception()));
  }
}

}  // namespace nook::bake::api
