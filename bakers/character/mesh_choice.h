// The choice of meshes of a bake, as recipes store it.
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/import/import_options.h"

namespace nook::bake {

// Adds the choice to a recipe; nothing if all meshes are in. stored_meshes (recipe.h) reads it back.
void store_meshes(nlohmann::ordered_json& recipe, const MeshSelection& meshes);

}  // namespace nook::bake
