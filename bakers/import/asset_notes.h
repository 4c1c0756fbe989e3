// What a glTF file says about its owner and its licence.
#pragma once

#include <filesystem>
#include <string>

#include "bakers/import/linked_files.h"

namespace nook::bake {

// Texts are as in the file, and empty where it says nothing.
struct AssetNotes {
  std::string copyright;  // asset.copyright
  std::string generator;  // asset.generator
  // Of asset.extras, where exporters of model libraries write them.
  std::string title, author, licence, source;
};

// Fails with BAD_FILE, as the import does; the caller adds the name of the file.
AssetNotes read_asset_notes(const std::filesystem::path& path, LinkedFiles linked = LinkedFiles::folder);

}  // namespace nook::bake
