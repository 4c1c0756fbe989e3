// The choice of meshes of a bake, for commands that read its model and its character again.
#pragma once

#include <cstddef>
#include <span>

#include "bakers/import/import_options.h"

namespace nook::tool {

// Returns the options with the choice of meshes in the recipe of the model in these bytes, unless they have a
// choice of their own. Bytes that are not a model change nothing: whoever reads them next tells what is
// wrong.
bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, std::span<const std::byte> model_bytes);

}  // namespace nook::tool
