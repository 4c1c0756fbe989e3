// Gets the mesh selection of a bake, for commands that read the bake's model and character again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Returns `reading` with the mesh selection from the recipe of `baked`. If `reading` already has a selection,
// it is not changed. Prints the selection, unless the command is quiet.
bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, const std::filesystem::path& baked,
                                       std::string_view recipe, const CommonOptions& common);

// As above, with the recipe of the model in these bytes. If the bytes are not a model, nothing is changed.
// The code that reads the model afterwards reports the error.
bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, const std::filesystem::path& baked,
                                       std::span<const std::byte> model_bytes, const CommonOptions& common);

}  // namespace nook::tool
