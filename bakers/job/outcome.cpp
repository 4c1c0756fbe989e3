#include "bakers/job/outcome.h"

#include <cstdio>
#include <new>
#include <stdexcept>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

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

}  // namespace nook::bake
