// The result and the text that a caller of the C interface gets for an exception.
#pragma once

#include <nook/nook.h>

#include <exception>

namespace nook::bake {

struct Outcome {
  nook_result result = NOOK_OK;
  char text[480] = "";
};

Outcome outcome_of(const std::exception_ptr& exception) noexcept;

}  // namespace nook::bake
