// The baked model of an imported character, for bakes that add to it.
#pragma once

#include <cstddef>
#include <span>

#include "bakers/import/gltf.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Reads the character's baked model. Throws Failure: BAD_FILE (no model, or that of another character),
// FILE_VERSION.
CharacterModel model_of_character(std::span<const std::byte> bytes, const ImportedCharacter& character);

}  // namespace nook::bake
