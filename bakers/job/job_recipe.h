// What a job's descriptor asks for, with the preset's values filled in.
#pragma once

#include <nook/nook_bake.h>

#include "bakers/character/recipe.h"

namespace nook::bake {

// Throws INVALID_ARGUMENT: unknown enum values, numbers out of range, unknown clips, no poses at all.
Recipe recipe_of(const nook_bake_job_desc& desc, const ImportedCharacter& character);

}  // namespace nook::bake
