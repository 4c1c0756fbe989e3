#include <cstdio>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/isa.h"
#include "sdk/src/core/version.h"

namespace nook::api {
namespace {

// The message is a plain array of bytes. So no destructor has to run when a thread ends or the library is
// unloaded.
thread_local char last_message[640] = "";

}  // namespace

nook_result fail(const char* function, nook_result code, const char* text) noexcept {
  std::snprintf(last_message, sizeof last_message, "%s: %s", function, text);
  return code;
}

}  // namespace nook::api

using namespace nook;

const char* nook_last_message(void) {
  return api::last_message;
}

uint32_t nook_version(void) {
  return NOOK_VERSION;
}

const char* nook_version_text(void) {
  return version_text;
}

const char* nook_result_name(nook_result result) {
  switch (result) {
#define NOOK_RESULT_CASE(name) \
  case name:                   \
    return #name
    NOOK_RESULT_CASE(NOOK_OK);
    NOOK_RESULT_CASE(NOOK_ERROR_INVALID_ARGUMENT);
    NOOK_RESULT_CASE(NOOK_ERROR_INVALID_HANDLE);
    NOOK_RESULT_CASE(NOOK_ERROR_OUT_OF_MEMORY);
    NOOK_RESULT_CASE(NOOK_ERROR_BAD_FILE);
    NOOK_RESULT_CASE(NOOK_ERROR_FILE_VERSION);
    NOOK_RESULT_CASE(NOOK_ERROR_VERSION);
    NOOK_RESULT_CASE(NOOK_ERROR_UNSUPPORTED);
    NOOK_RESULT_CASE(NOOK_ERROR_GL);
    NOOK_RESULT_CASE(NOOK_ERROR_CANCELLED);
    NOOK_RESULT_CASE(NOOK_ERROR_INTERNAL);
#undef NOOK_RESULT_CASE
    default:
      return "unknown result";
  }
}

nook_result nook_context_create(const nook_context_desc* desc, nook_context* out) {
  return api::enter("nook_context_create", [&] {
    need(out, "out");
    *out = nullptr;
    const nook_context_desc settings = read_descriptor(desc);
    if (!settings.allocator.allocate != !settings.allocator.release)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.allocator has only one of its two functions (got %s, need both or none); set "
                    "allocate and release, or leave both NULL",
                    settings.allocator.allocate ? "allocate" : "release");
    check_known("desc.isa", settings.isa, last_isa());
    check_fits("desc.units_per_metre", settings.units_per_metre,
               settings.units_per_metre >= 1e-6f && settings.units_per_metre <= 1e6f,
               "1e-6 to 1e6; 1 means metres, 100 means centimetres");
    const Isa isa = choose_isa(settings.isa);
    HostMemory memory(settings.allocator);
    void* place = static_cast<Memory&>(memory).allocate(sizeof(nook_context_s), alignof(nook_context_s));
    *out = new (place) nook_context_s(settings);
    (*out)->log(NOOK_LOG_INFO, "nook %s, instruction set %s", version_text, shadow_kernels(isa)->name);
  });
}

void nook_context_destroy(nook_context* context) {
  if (!context || !*context) return;
  (*context)->release();
  *context = nullptr;
}
