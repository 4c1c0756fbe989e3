// What every evaluation of a baked character does: reads the character and its model, runs on the asked-for
// threads, and hands over a report.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "character/model.h"
#include "cli/common_options.h"
#include "import/gltf.h"

namespace nook::cli {

struct EvaluationOptions {
  CommonOptions common;
  std::filesystem::path character, model;
};

// The two files, as a command's positional arguments.
void add_evaluated_files(CLI::App& command, EvaluationOptions& options);

struct BakedCharacter {
  bake::ImportedCharacter character;
  std::vector<std::byte> model_bytes;
  CharacterModel model;
};

// Throws ToolError (bad input) that names the file: one that cannot be read, or a model of another character.
BakedCharacter read_baked_character(const EvaluationOptions& options);

// Writes what evaluate returns to the report's file, and its rows as a table to the output stream. A report
// that cannot be written is known before the work begins.
void run_evaluation(const CommonOptions& options, const std::function<nlohmann::ordered_json()>& evaluate);

}  // namespace nook::cli
