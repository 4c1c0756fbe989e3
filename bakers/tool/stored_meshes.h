// Finds out which meshes of a file were baked, for commands that read the baked model and its character
// again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Returns the import options `reading`, with the mesh selection from the recipe of the file `baked`. If
// `reading` already contains a selection, it is returned unchanged. Prints the selection, unless the command
// is quiet.
bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, const std::filesystem::path& baked,
                                       std::string_view recipe, const CommonOptions& common);

// The same, but with the recipe of the model in these bytes. If the bytes are not a model, returns `reading`
// unchanged. The code that reads the model afterwards reports the error.
bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, const std::filesystem::path& baked,
                                       std::span<const std::byte> model_bytes, const CommonOptions& common);

}  // namespace nook::tool
