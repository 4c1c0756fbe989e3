// The character that a command reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {

// Prints the character's warnings. Failures name the file.
bake::ImportedCharacter read_character(const std::filesystem::path& path, bake::LinkedFiles linked,
                                       const CommonOptions& common);

// Throws ToolError (bad arguments) that names the first clip of --clips that the character lacks and lists
// all that it has.
void require_clips(const std::vector<std::string>& wanted, const bake::ImportedCharacter& character);

}  // namespace nook::tool
