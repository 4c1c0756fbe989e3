// The finding of a check of a pose.
#pragma once

#include <nook/nook_character.h>

#include <cstdint>

#include "sdk/src/core/compiler.h"

namespace nook {

// The answers of nook_pose_check_info.
struct PoseFinding {
  nook_pose_fault fault = NOOK_POSE_FAULT_NONE;
  double max_error = 0, rms_error = 0;  // shares of the bounding radius times the scale of the pose
  std::uint32_t worst_bone = 0;
  std::uint32_t fitting_skin = 0;
  double scale = 1;
  char text[512] = {};
};

// Puts the text, which is cut where it is too long.
void say(PoseFinding& finding, const char* format, ...) NOOK_PRINTF(2, 3);

}  // namespace nook
