#include "bakers/character/mesh_choice.h"

#include <algorithm>

namespace nook::bake {
namespace {

// Sorts the names and removes repeated ones, because neither their order nor repetition changes the choice.
std::vector<std::string> sorted_names(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

void store_meshes(nlohmann::ordered_json& recipe, const MeshSelection& meshes) {
  if (!meshes.only.empty()) recipe["meshes"]["only"] = sorted_names(meshes.only);
  if (!meshes.without.empty()) recipe["meshes"]["without"] = sorted_names(meshes.without);
}

}  // namespace nook::bake
