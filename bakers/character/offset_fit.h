// Refits the bias and the scale of each vertex of a model to the poses that a game shows most. The mean AO
// over these poses differs from the mean AO over all possible poses. The refit makes the model neither larger
// nor slower.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Changes the bias of each vertex, and the scale of its shadow, to minimise the squared error over the poses.
// Nothing else is changed. The old bias is a prior with the weight of four poses, and the old scale is a
// prior too, so that a few noisy poses do no harm. AO is clamped: a prediction below 0 has no error at a
// vertex that is black, and a prediction above 1 has no error at a vertex that is fully open. Returns the
// root mean square, over vertices, of the mean change of AO.
double fit_offsets(CharacterModel& model, std::span<const Pose> poses, const AoTargets& targets);

struct OffsetFitSettings {
  std::uint32_t rays = 64;  // per vertex and pose
  std::uint64_t seed = 1;
};

// Traces the poses, and calls fit_offsets with the result. The bits do not depend on the number of threads.
// Throws Failure: INVALID_ARGUMENT (no poses, or another number of bones), CANCELLED.
double calibrate_offsets(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                         const OffsetFitSettings& settings, const Progress& progress = {});

// At the end of a bake without clips, biases are refitted to the rest pose. The rest pose has the weight of
// this many poses and the old bias has the weight of four, so the rest pose has a share of one third. The
// rest pose is similar to standing or idling, unless the arms are spread. docs/character.md compares other
// weights and poses.
inline constexpr std::size_t rest_pose_weight = 2;

}  // namespace nook::bake
