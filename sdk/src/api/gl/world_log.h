// Logs frames of the world pass that were accepted, but that are probably not what the host meant. The view
// may be another matrix, the cone may be in radians, the light may come from below, or the mask may be
// missing.
#pragma once

#include <nook/nook_world.h>

#include "sdk/src/character/scene.h"
#include "sdk/src/core/context.h"

namespace nook::api {

// What a pass has logged. Each kind is logged once.
struct WorldReports {
  bool view = false, cone = false, axis = false, mask = false;
  // True after a frame whose light came from above the ground. The sun may set later.
  bool axis_was_above = false;
};

// `view` and `frame` must have passed their checks. Makes no OpenGL calls.
void log_world_frame(const Context& context, WorldReports& reports, const float (&view)[16],
                     nook_gbuffer_ao gbuffer_ao, const nook_world_frame_desc& frame, const Scene* scene);

}  // namespace nook::api
