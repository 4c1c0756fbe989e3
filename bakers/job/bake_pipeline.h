// Makes the bytes of a .nook file and a report from a recipe.
#pragma once

#include <span>

#include "bakers/character/recipe.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

// Throws Failure: INVALID_ARGUMENT (there are no poses, or settings are out of range), CANCELLED.
BakedFile bake_by_recipe(const ImportedCharacter& character, const Recipe& recipe,
                         std::span<const Pose> extra_poses, const StageReport& progress);

}  // namespace nook::bake
