// A baked character to be measured: the file that it came from and its model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "character/model.h"
#include "cli/common_options.h"
#include "cli/distinct_files.h"
#include "import/gltf.h"

namespace nook::cli {

struct EvaluationOptions {
  CommonOptions common;
  std::filesystem::path character, model;
};

// The two files, as a command's positional arguments.
void add_evaluated_files(CLI::App& command, EvaluationOptions& options);

// As inputs of the command.
std::vector<NamedFile> evaluated_files(const EvaluationOptions& options);

struct BakedCharacter {
  bake::ImportedCharacter character;
  std::vector<std::byte> model_bytes;
  CharacterModel model;
};

// Throws ToolError (bad input) that names the file: one that cannot be read, or a model of another character.
BakedCharacter read_baked_character(const EvaluationOptions& options);

}  // namespace nook::cli
