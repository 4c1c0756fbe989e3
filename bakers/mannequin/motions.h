#pragma once

#include <vector>

#include "bakers/mannequin/pose.h"

namespace nook::mannequin {

/// A looping motion. `pose_at` takes a phase from 0 to 1. Phases 0 and 1 give the same pose.
struct Clip {
  const char* name;
  double duration_s;
  Pose (*pose_at)(const Skeleton& skeleton, double phase);
};

/// Returns the clips Idle, Walk, Run, Crouch, Sit, Wave, Punch and Dance.
const std::vector<Clip>& all_clips();

// Standing, walking and running.
Pose pose_idle(const Skeleton& skeleton, double phase);
Pose pose_walk(const Skeleton& skeleton, double phase);
Pose pose_run(const Skeleton& skeleton, double phase);

// Other actions.
Pose pose_crouch(const Skeleton& skeleton, double phase);
Pose pose_sit(const Skeleton& skeleton, double phase);
Pose pose_wave(const Skeleton& skeleton, double phase);
Pose pose_punch(const Skeleton& skeleton, double phase);
Pose pose_dance(const Skeleton& skeleton, double phase);

}  // namespace nook::mannequin
