#include "bakers/tool/stored_meshes.h"

#include <string_view>

#include "bakers/character/recipe.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {

bake::ImportOptions with_stored_meshes(bake::ImportOptions reading, std::span<const std::byte> model_bytes) {
  if (!reading.meshes.only.empty() || !reading.meshes.without.empty()) return reading;
  try {
    reading.meshes = bake::stored_meshes(std::string_view(read_character_model(model_bytes).recipe));
  } catch (const Failure&) {
    return reading;
  }
  return reading;
}

}  // namespace nook::tool
