#include "bakers/job/character_model.h"

#include <algorithm>
#include <string_view>

#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

void require_same_character(const CharacterModel& model, const SkinnedMesh& mesh) {
  bool is_same = model.bone_count() == mesh.bones.size() && model.vertex_count() == mesh.vertex_count() &&
                 std::equal(model.file_to_welded.begin(), model.file_to_welded.end(),
                            mesh.file_to_welded.begin(), mesh.file_to_welded.end());
  for (std::size_t b = 0; is_same && b < mesh.bones.size(); ++b)
    is_same = mesh.bones[b].name == std::string_view(model.bone_names[b]);
  if (!is_same)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the model is that of another character (got %zu vertices and %zu bones, need %zu and %zu "
                  "in the same order); bake the character first",
                  model.vertex_count(), model.bone_count(), mesh.vertex_count(), mesh.bones.size());
}

}  // namespace

CharacterModel model_of_character(std::span<const std::byte> bytes, const ImportedCharacter& character) {
  CharacterModel model = read_character_model(bytes);
  require_same_character(model, character.mesh);
  return model;
}

}  // namespace nook::bake
