#include "bakers/tool/character/evaluated_files.h"

#include "bakers/tool/command_line.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/input_file.h"

namespace nook::tool {

void add_evaluated_files(Command command, EvaluatedFiles& files) {
  command.add_option("input", files.character, "the character it was baked from, .glb or .gltf").required();
  command.add_option("model", files.model, "the .nook file").required();
  add_linked_files_option(command, files.linked);
}

std::vector<NamedFile> named_files(const EvaluatedFiles& files) {
  return {{"the character", files.character}, {"the model", files.model}};
}

measure::BakedCharacter read_evaluated_files(const EvaluatedFiles& files) {
  auto imported =
      naming_file(files.character, [&] { return measure::read_character(files.character, files.linked); });
  auto bytes = read_file(files.model);
  return naming_file(files.model,
                     [&] { return measure::read_baked_character(std::move(imported), std::move(bytes)); });
}

}  // namespace nook::tool
