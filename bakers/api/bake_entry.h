// Every C function that can fail runs its body through these functions. They convert an exception to a result
// code and to the last message of this thread.
#pragma once

#include <utility>

#include "bakers/job/bake_job.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::api {

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
