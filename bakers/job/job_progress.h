// Progress in the form of the C interface.
#pragma once

#include <nook/nook_bake.h>

#include "bakers/job/bake_job.h"

namespace nook::bake {

inline nook_bake_progress public_progress(const JobProgress& p) {
  return {std::uint32_t(sizeof(nook_bake_progress)), p.stage, p.done, p.total};
}

// Returns an empty listener if there is no callback.
inline BakeJob::Listener listener_of(nook_bake_progress_fn call, void* user) {
  if (!call) return {};
  return [call, user](const JobProgress& p) {
    const nook_bake_progress now = public_progress(p);
    return call(user, &now) != 0;
  };
}

}  // namespace nook::bake
