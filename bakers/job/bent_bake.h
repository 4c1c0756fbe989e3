// Bent normals for a model that is already baked.
#pragma once

#include <nook/nook_bake.h>

#include <cstddef>
#include <cstdint>

#include "bakers/import/gltf.h"
#include "bakers/job/baked_file.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

struct BentTask {
  std::uint32_t auto_poses = 48;
  std::uint32_t samples_per_clip = 3;
  std::uint32_t rays = 128;
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) for a number out of its range.
BentTask bent_task_of(const nook_bake_bent_desc& desc);

// Adds occluded directions to the model of `character` (character_model.h), fitted to ray tracing in
// automatic poses and those of the clips that the model was fitted to, or of all clips where it has no
// recipe. What the model has besides stays as it is. The stage is JobStage::raytrace and counts poses.
// Throws Failure: BAD_FILE (a recipe that is not that of the character), CANCELLED.
BakedFile bake_bent_file(const ImportedCharacter& character, CharacterModel model, const BentTask& task,
                         const StageReport& progress);

}  // namespace nook::bake
