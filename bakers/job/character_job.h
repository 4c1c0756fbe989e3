// Bakes a character. First makes a recipe from a descriptor, then makes the file and the report from the
// recipe.
#pragma once

#include <nook/experimental/nook_trace.h>

#include <span>

#include "bakers/character/recipe.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

// Makes the recipe for a job's descriptor, and fills in the values of the preset.

// Throws INVALID_ARGUMENT for unknown enum values, numbers out of range, unknown clips, and if there are no
// poses.
Recipe recipe_of(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study,
                 const ImportedCharacter& character);

// Poses that were recorded in a game. At the end of a bake, the biases of the vertices are fitted to these
// poses. The list may be empty.
struct CalibrationPoses {
  std::vector<Pose> poses;
};

// Returns the identity of a call of bake_by_recipe with the same arguments.
BakeIdentity identify_character(const ImportedCharacter& character, const Recipe& recipe,
                                std::span<const Pose> extra_poses, const CalibrationPoses& calibration = {});

// Throws Failure: INVALID_ARGUMENT (there are no poses, or settings are out of range), CANCELLED.
BakedFile bake_by_recipe(const ImportedCharacter& character, const Recipe& recipe,
                         std::span<const Pose> extra_poses, const StageReport& progress,
                         const CalibrationPoses& calibration = {});

// Ray traces recorded poses, fits the vertex biases of a baked model to the result, and judges the model
// again. Only the biases and the judgement change.

struct CalibrationTask {
  std::uint32_t rays = 64;  // rays per vertex and pose
  std::uint64_t seed = 1;
};

// Returns the identity of a call of calibrate_file for the model in these bytes.
BakeIdentity identify_calibration(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                                  const CalibrationPoses& calibration, const CalibrationTask& task);

// If `identity` is not empty, the file stores it. Throws Failure: INVALID_ARGUMENT (no poses), BAD_FILE (the
// recipe belongs to another character), CANCELLED.
BakedFile calibrate_file(const ImportedCharacter& character, CharacterModel model,
                         const CalibrationPoses& calibration, const CalibrationTask& task,
                         const StageReport& progress, const BakeIdentity& identity = {});

}  // namespace nook::bake
