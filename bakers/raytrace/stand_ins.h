// Chooses stand-ins and reports progress, for bakes. The choice takes as long as tracing some tens of poses.
#pragma once

#include <cstdint>
#include <span>

#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake {

// Chooses the same points as the overload without `progress`. Meanwhile, it reports that 0 poses are done,
// because the poses are traced later. Throws Failure(NOOK_ERROR_CANCELLED) if progress returns false.
StandIns choose_stand_ins(const SkinnedMesh& mesh, std::span<const Pose> poses, std::uint64_t seed,
                          const Progress& progress);

}  // namespace nook::bake
