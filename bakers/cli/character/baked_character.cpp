#include "cli/character/baked_character.h"

#include <CLI/CLI.hpp>
#include <string>

#include "character/model_file.h"
#include "cli/input_file.h"
#include "cli/tool_error.h"

namespace nook::cli {
namespace {

void require_same_character(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                            const std::filesystem::path& path) {
  const auto differ = [&](const char* what, std::size_t got, std::size_t needed) {
    if (got != needed)
      throw ToolError(exit_bad_input, path.string() + ": the model was not baked from this character (" +
                                          what + ": got " + std::to_string(got) + ", need " +
                                          std::to_string(needed) + "); bake it again");
  };
  differ("bones", model.bone_count(), mesh.bones.size());
  differ("vertices", model.vertex_count(), mesh.vertex_count());
  differ("file vertices", model.file_to_welded.size(), mesh.file_to_welded.size());
}

}  // namespace

void add_evaluated_files(CLI::App& command, EvaluationOptions& options) {
  command.add_option("input", options.character, "the character it was baked from, .glb or .gltf")
      ->required();
  command.add_option("model", options.model, "the .nook file")->required();
}

std::vector<NamedFile> evaluated_files(const EvaluationOptions& options) {
  return {{"the character", options.character}, {"the model", options.model}};
}

BakedCharacter read_baked_character(const EvaluationOptions& options) {
  BakedCharacter baked;
  baked.character = naming_file(options.character, [&] { return bake::import_gltf(options.character); });
  baked.model_bytes = read_file(options.model);
  baked.model = naming_file(options.model, [&] { return read_character_model(baked.model_bytes); });
  require_same_character(baked.character.mesh, baked.model, options.model);
  return baked;
}

}  // namespace nook::cli
