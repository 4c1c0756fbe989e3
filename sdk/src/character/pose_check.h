// Compares a pose with vertices that the host skinned itself, and finds out what is likely wrong.
#pragma once

#include <array>
#include <span>

#include "sdk/src/character/pose_finding.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/memory.h"

namespace nook {

// A vertex of BindData::vertices and where the host's skinning puts it, in the world.
struct SkinnedVertex {
  std::uint32_t rest_vertex = 0;
  std::array<double, 3> position_ws{};
};

// Distances up to `tolerance`, a share of the bounding radius, count as equal.  Throws Failure if no vertex
// hangs on bones with transforms alone, or as for_each_transform does. The source must have passed
// check_pose_source.
PoseFinding find_pose_fault(const CharacterModel& model, const PoseSource& source,
                            std::span<const SkinnedVertex> vertices, double tolerance, Memory* memory);

}  // namespace nook
