#include "bakers/api/bake_entry.h"

#include <nook/nook_bake.h>

#include <cstdio>

namespace nook::bake::api {
namespace {

// This is a plain array, because it needs no destructor when a thread ends or the library is unloaded.
thread_local char last_message[640] = "";

}  // namespace

nook_result fail(const char* function, const Outcome& outcome) noexcept {
  std::snprintf(last_message, sizeof last_message, "%s: %s", function, outcome.text);
  return outcome.result;
}

}  // namespace nook::bake::api

const char* nook_bake_last_message(void) {
  return nook::bake::api::last_message;
}
