// The meshes that a bake reads, as recipes store them.
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/import/import_options.h"

namespace nook::bake {

// Adds the mesh selection to a recipe. Adds nothing if the bake reads all meshes. Read the selection with
// stored_meshes (recipe.h).
void store_meshes(nlohmann::ordered_json& recipe, const MeshSelection& meshes);

}  // namespace nook::bake
