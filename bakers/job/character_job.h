// Bakes a character: makes the recipe of a descriptor, and the file and report of a recipe.
#pragma once

#include <nook/experimental/nook_trace.h>

#include <span>

#include "bakers/character/recipe.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

// Makes the recipe of a job's descriptor, with the preset's values filled in.

// Throws INVALID_ARGUMENT for unknown enum values, numbers out of range, unknown clips, and if there are no
// poses.
Recipe recipe_of(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study,
                 const ImportedCharacter& character);

// Recorded poses of a game, to which the constants of the vertices are fitted last; may be empty.
struct CalibrationPoses {
  std::vector<Pose> poses;
};

// Identifies the bake of bake_by_recipe with the same arguments.
BakeIdentity identify_character(const ImportedCharacter& character, const Recipe& recipe,
                                std::span<const Pose> extra_poses, const CalibrationPoses& calibration = {});

// Throws Failure: INVALID_ARGUMENT (there are no poses, or settings are out of range), CANCELLED.
BakedFile bake_by_recipe(const ImportedCharacter& character, const Recipe& recipe,
                         std::span<const Pose> extra_poses, const StageReport& progress,
                         const CalibrationPoses& calibration = {});

// Fits the constants of a baked model's vertices to recorded poses, against ray tracing, and judges it anew.
// Everything else of the model stays as it is.

struct CalibrationTask {
  std::uint32_t rays = 64;  // for each vertex and pose
  std::uint64_t seed = 1;
};

// Identifies the bake of calibrate_file for the model in these bytes.
BakeIdentity identify_calibration(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                                  const CalibrationPoses& calibration, const CalibrationTask& task);

// The file stores the identity if it has text. Throws Failure: INVALID_ARGUMENT (no poses), BAD_FILE (a
// recipe that is not that of the character), CANCELLED.
BakedFile calibrate_file(const ImportedCharacter& character, CharacterModel model,
                         const CalibrationPoses& calibration, const CalibrationTask& task,
                         const StageReport& progress, const BakeIdentity& identity = {});

}  // namespace nook::bake
