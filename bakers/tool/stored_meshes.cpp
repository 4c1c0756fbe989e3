#include "bakers/tool/stored_meshes.h"

#include <cstdio>
#include <string>

#include "bakers/character/recipe.h"
#include "platform/printable.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {
namespace {

bool chooses(const bake::MeshSelection& meshes) {
  return !meshes.only.empty() || !meshes.without.empty();
}

std::string options_of(const bake::MeshSelection& meshes) {
  std::string text;
  for (const std::string& name : meshes.only) text += " --mesh \"" + name + "\"";
  for (const std::string& name : meshes.without) text += " --without \"" + name + "\"";
  return text;
}

}  // namespace

bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, const std::filesystem::path& baked,
                                       std::string_view recipe, const CommonOptions& common) {
  if (chooses(reading.meshes)) return reading;
  reading.meshes = bake::stored_meshes(recipe);
  if (chooses(reading.meshes) && !common.quiet)
    std::fprintf(stderr, "nook: %s was baked with%s; this command reads the same meshes\n",
                 platform::printable(baked.string()).c_str(),
                 platform::printable(options_of(reading.meshes)).c_str());
  return reading;
}

bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, const std::filesystem::path& baked,
                                       std::span<const std::byte> model_bytes, const CommonOptions& common) {
  try {
    const CharacterModel model = read_character_model(model_bytes);
    return with_stored_meshes(std::move(reading), baked, std::string_view(model.recipe), common);
  } catch (const Failure&) {
    return reading;
  }
}

}  // namespace nook::tool
