// Progress in the form of the C interface.
#pragma once

#include <nook/nook_bake.h>

#include "bakers/job/bake_job.h"

namespace nook::bake {

// The text that a program shows to its user.
inline const char* text_of(JobStage stage) {
  switch (stage) {
    case JobStage::waiting:
      return "waiting";
    case JobStage::raytrace:
      return "ray tracing";
    case JobStage::initialise:
      return "initialising";
    case JobStage::fit:
      return "fitting";
    case JobStage::casters:
      return "fitting casters";
    case JobStage::btf:
      return "compressing colours";
    case JobStage::votf:
      return "compressing visibility";
    case JobStage::view_map:
      return "making the view map";
    case JobStage::relief:
      return "finding the relief";
    case JobStage::done:
      break;
  }
  return "done";
}

inline nook_bake_progress public_progress(const JobProgress& p) {
  const nook_bake_state state = p.finished                     ? NOOK_BAKE_DONE
                                : p.stage == JobStage::waiting ? NOOK_BAKE_WAITING
                                                               : NOOK_BAKE_RUNNING;
  return {std::uint32_t(sizeof(nook_bake_progress)), state, text_of(p.stage), p.done, p.total};
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
