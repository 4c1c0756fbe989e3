#include "samples/mannequin/clips.h"

namespace nook_samples::mannequin {

const std::vector<Clip>& all_clips() {
  static const std::vector<Clip> clips = {
      {"Idle", 4.0, pose_idle},     {"Walk", 1.1, pose_walk},   {"Run", 1.4, pose_run},
      {"Crouch", 3.0, pose_crouch}, {"Sit", 4.0, pose_sit},     {"Wave", 2.4, pose_wave},
      {"Punch", 1.6, pose_punch},   {"Dance", 2.0, pose_dance},
  };
  return clips;
}

}  // namespace nook_samples::mannequin
