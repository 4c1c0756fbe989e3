// The parts of every fuzz target of the C ABI: contexts, OpenGL handles, and what a result may be.
#pragma once

#include <nook/nook_gl.h>

#include <cstdlib>

#include "tests/fuzz/silent_gl.h"

namespace nook::test {

// Returns whether a call succeeded. INTERNAL is a fault of the library whatever the input was.
inline bool ok(nook_result result) {
  if (result == NOOK_ERROR_INTERNAL || result > NOOK_OK) std::abort();
  return result == NOOK_OK;
}

// Jobs run backwards, so that nothing can rely on their order.
inline void run_backwards(void*, std::uint32_t count, nook_job_fn body, void* body_user) {
  while (count > 0) body(body_user, --count);
}

// Made once: contexts hold no state that an input could change.
// isa: 0 to 5; where the processor lacks the set, the best one is used.
inline nook_context context_with_jobs(bool with_jobs, std::uint32_t isa = NOOK_ISA_AUTO) {
  static nook_context made[2][6];
  nook_context& context = made[with_jobs ? 1 : 0][isa];
  if (context) return context;
  nook_context_desc desc;
  ok(nook_context_desc_init(&desc));
  if (with_jobs) desc.parallel_for = run_backwards;
  desc.isa = nook_isa(isa);
  if (ok(nook_context_create(&desc, &context))) return context;
  desc.isa = NOOK_ISA_AUTO;
  if (!ok(nook_context_create(&desc, &context))) std::abort();
  return context;
}

// tier: 33 or 43. Made once for each.
inline nook_gl gl_of_tier(int tier) {
  static const auto make = [](int max_tier) {
    nook_gl_desc desc;
    ok(nook_gl_desc_init(&desc));
    desc.get_proc = silent_gl_proc;
    desc.max_tier = max_tier;
    nook_gl gl = nullptr;
    if (!ok(nook_gl_create(context_with_jobs(max_tier == 33), &desc, &gl))) std::abort();
    return gl;
  };
  static const nook_gl feedback = make(33), compute = make(43);
  return tier == 33 ? feedback : compute;
}

}  // namespace nook::test
