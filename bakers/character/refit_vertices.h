// The linear layer of a model for another mesh of the same rig, such as a level of detail. Spheres, key
// points, levels and casters stay: only what each vertex makes of the key points' shadows is fitted, to ray
// tracing of the other mesh, so that the AO follows its own shape.
#pragma once

#include <span>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

struct RefitSettings {
  std::uint32_t rays = 128;  // for each vertex and pose
  std::uint64_t seed = 1;
};

// The mesh has the bones of the model, in the same order, and one matrix a bone in each pose. The result has
// the mesh's welded vertices; bind data and the rest surface are the caller's to set. Throws
// Failure(NOOK_ERROR_CANCELLED) if progress returns false.
CharacterModel refit_vertices(const CharacterModel& model, const SkinnedMesh& mesh,
                              std::span<const Pose> poses, const RefitSettings& settings,
                              const Progress& progress = {});

}  // namespace nook::bake
