// The choice of meshes of a bake, as recipes store it.
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/import/import_options.h"

namespace nook::bake {

// Adds the choice to a recipe. Adds nothing if the bake reads all meshes. stored_meshes (recipe.h) reads the
// choice.
void store_meshes(nlohmann::ordered_json& recipe, const MeshSelection& meshes);

}  // namespace nook::bake
