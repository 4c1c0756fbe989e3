#include "api/entry.h"

#include <nook/nook_bake.h>

#include <cstdio>
#include <new>
#include <stdexcept>

namespace nook::bake::api {
namespace {

// Plain bytes need no destruction when a thread ends or the library is unloaded.
thread_local char last_message[640] = "";

Outcome make_outcome(nook_result result, const char* text) noexcept {
  Outcome outcome;
  outcome.result = result;
  std::snprintf(outcome.text, sizeof outcome.text, "%s", text);
  return outcome;
}

}  // namespace

Outcome outcome_of(const std::exception_ptr& exception) noexcept {
  try {
    std::rethrow_exception(exception);
  } catch (const Failure& failure) {
    return make_outcome(failure.code(), failure.what());
  } catch (const std::bad_alloc&) {
    return make_outcome(
        NOOK_ERROR_OUT_OF_MEMORY,
        "not enough memory; use fewer poses, directions or texels, or free memory and call again");
  } catch (const std::length_error&) {
    return make_outcome(NOOK_ERROR_OUT_OF_MEMORY,
                        "more memory is needed than can be addressed; use smaller data");
  } catch (const std::exception& e) {
    return make_outcome(NOOK_ERROR_INTERNAL, e.what());
  } catch (...) {
    return make_outcome(NOOK_ERROR_INTERNAL, "an unknown exception; please report it");
  }
}

nook_result fail(const char* function, const Outcome& outcome) noexcept {
  std::snprintf(last_message, sizeof last_message, "%s: %s", function, outcome.text);
  return outcome.result;
}

}  // namespace nook::bake::api

const char* nook_bake_last_message(void) {
  return nook::bake::api::last_message;
}
uint32_t nook_bake_version(void) {
  return NOOK_VERSION;
}
