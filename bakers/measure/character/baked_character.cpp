#include "bakers/measure/character/baked_character.h"

#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

void require_same(const char* what, std::size_t got, std::size_t needed) {
  if (got != needed)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the model was not baked from this character (%s: got %zu, need %zu); bake it again", what,
                  got, needed);
}

}  // namespace

bake::ImportedCharacter read_character(const std::filesystem::path& path, bake::LinkedFiles linked) {
  return bake::import_gltf(path, linked);
}

BakedCharacter read_baked_character(bake::ImportedCharacter character, std::vector<std::byte> model_bytes) {
  BakedCharacter baked;
  baked.character = std::move(character);
  baked.model_bytes = std::move(model_bytes);
  baked.model = read_character_model(baked.model_bytes);
  const bake::SkinnedMesh& mesh = baked.character.mesh;
  require_same("bones", baked.model.bone_count(), mesh.bones.size());
  require_same("vertices", baked.model.vertex_count(), mesh.vertex_count());
  require_same("file vertices", baked.model.file_to_welded.size(), mesh.file_to_welded.size());
  return baked;
}

}  // namespace nook::measure
