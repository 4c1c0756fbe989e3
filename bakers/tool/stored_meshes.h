// Gets the mesh selection of a bake, for commands that read the bake's model and character again.
#pragma once

#include <cstddef>
#include <span>

#include "bakers/import/import_options.h"

namespace nook::tool {

// Returns `reading` with the mesh selection from the recipe of the model in these bytes. If `reading` already
// has a selection, it is not changed. If the bytes are not a model, nothing is changed either. The code that
// reads the model afterwards reports the error.
bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, std::span<const std::byte> model_bytes);

}  // namespace nook::tool
