// A baked character to be measured: the file that it came from and its model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "bakers/import/gltf.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

struct BakedCharacter {
  bake::ImportedCharacter character;
  std::vector<std::byte> model_bytes;
  CharacterModel model;
};

// Throws Failure (BAD_FILE) for a character that cannot be imported.
bake::ImportedCharacter read_character(const std::filesystem::path& path, bake::LinkedFiles linked);

// Throws Failure (BAD_FILE, FILE_VERSION) for bytes that are no model, or the model of another character.
BakedCharacter read_baked_character(bake::ImportedCharacter character, std::vector<std::byte> model_bytes);

}  // namespace nook::measure
