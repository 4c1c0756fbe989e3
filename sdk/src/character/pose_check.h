// Compares a pose with vertices that the host skinned itself, and finds out what is likely wrong.
#pragma once

#include <nook/nook_pose.h>

#include <span>

#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/memory.h"

namespace nook {

// A vertex of BindData::vertices and where the host's skinning puts it, in the world.
struct SkinnedVertex {
  std::uint32_t rest_vertex = 0;
  std::array<double, 3> position_ws{};
};

// The parts of nook_pose_check that the check answers.
struct PoseFinding {
  nook_pose_fault fault = NOOK_POSE_RIGHT;
  double max_error = 0, rms_error = 0;  // shares of the bounding radius times the scale of the pose
  std::uint32_t worst_bone = 0;
  std::uint32_t fitting_skin = 0;
  double scale = 1;
  char text[512] = {};
};

// Distances up to `tolerance`, a share of the bounding radius, count as equal.  Throws Failure if no vertex
// hangs on bones with transforms alone, or as for_each_transform does. The source must have passed
// check_pose_source.
PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, double tolerance, Memory* memory);

}  // namespace nook
