// Makes a character from a host's arrays.
#pragma once

#include <nook/nook_bake.h>

#include "bakers/import/gltf.h"

namespace nook::bake {

// Throws INVALID_ARGUMENT with the first fault.
ImportedCharacter character_of_arrays(const nook_bake_source_desc& desc);

}  // namespace nook::bake
