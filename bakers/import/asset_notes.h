// Reads from a glTF file who owns it and which licence it has.
#pragma once

#include <filesystem>
#include <string>

#include "bakers/import/linked_files.h"

namespace nook::bake {

// Each text is copied from the file. It is empty if the file does not have it.
struct AssetNotes {
  std::string copyright;  // asset.copyright
  std::string generator;  // asset.generator
  // From asset.extras, where the exporters of model libraries write these texts.
  std::string title, author, licence, source;
};

// Fails with BAD_FILE if the import would fail. The message does not name the file; the caller must add the
// name.
AssetNotes read_asset_notes(const std::filesystem::path& path, LinkedFiles linked = LinkedFiles::folder);

}  // namespace nook::bake
