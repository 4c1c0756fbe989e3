// Poses of placed characters.
#pragma once

#include "samples/crowd/layout.h"

namespace crowd {

// The clip's pose at a time, moved to its place in the world.
Bones placed_pose(const Hero& hero, const Placement& placement, float time_s);

}  // namespace crowd
