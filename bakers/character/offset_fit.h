// The constant and the scale of each vertex of a model, fitted anew to the poses that are most likely in use.
// A constant costs neither capacity nor time per frame. It is needed because the mean over all possible poses
// differs from the mean over the poses that a game shows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Moves the constant of each vertex, and the scale of its shadow, to the least squared error over the poses;
// everything else stays. The old constant counts as much as four poses, and the old scale as a part of the
// poses, so that few poses with noise cannot do harm. Where ray tracing finds a vertex black, a prediction
// below black has no error, as AO is clamped; the same holds for open vertices. Returns the root mean square
// of the vertices' mean changes of AO.
double fit_offsets(CharacterModel& model, std::span<const Pose> poses, const AoTargets& targets);

struct OffsetFitSettings {
  std::uint32_t rays = 64;  // for each vertex and pose
  std::uint64_t seed = 1;
};

// The same against ray tracing. The bits do not depend on the number of threads. Throws Failure:
// INVALID_ARGUMENT (no poses, or another number of bones), CANCELLED.
double calibrate_offsets(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                         const OffsetFitSettings& settings, const Progress& progress = {});

// The weight of the rest pose, in poses, at the end of a bake without clips, and so its share beside the old
// constants, which count as four: a third. The rest pose resembles standing or idling, unless the arms are
// spread; docs/character.md measures other weights and poses.
inline constexpr std::size_t rest_pose_weight = 2;

}  // namespace nook::bake
