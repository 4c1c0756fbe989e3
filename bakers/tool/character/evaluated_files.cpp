#include "bakers/tool/character/evaluated_files.h"

#include <CLI/CLI.hpp>

#include "bakers/tool/input_file.h"

namespace nook::tool {

void add_evaluated_files(CLI::App& command, std::filesystem::path& character, std::filesystem::path& model) {
  command.add_option("input", character, "the character it was baked from, .glb or .gltf")->required();
  command.add_option("model", model, "the .nook file")->required();
}

std::vector<NamedFile> evaluated_files(const std::filesystem::path& character,
                                       const std::filesystem::path& model) {
  return {{"the character", character}, {"the model", model}};
}

measure::BakedCharacter read_evaluated_files(const std::filesystem::path& character,
                                             const std::filesystem::path& model) {
  auto imported = naming_file(character, [&] { return measure::read_character(character); });
  auto bytes = read_file(model);
  return naming_file(model,
                     [&] { return measure::read_baked_character(std::move(imported), std::move(bytes)); });
}

}  // namespace nook::tool
