// The recipe of a job's descriptor, with the preset's values filled in.
#pragma once

#include <nook/experimental/nook_trace.h>

#include "bakers/character/recipe.h"

namespace nook::bake {

// Throws INVALID_ARGUMENT for unknown enum values, numbers out of range, unknown clips, and if there are no
// poses.
Recipe recipe_of(const nook_bake_character_desc& desc, const nook_bake_character_study_desc& study,
                 const ImportedCharacter& character);

}  // namespace nook::bake
