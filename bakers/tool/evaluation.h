// Runs an evaluation of any kind on the requested threads, and writes its report. Also reads the input files
// of evaluations that measure a baked character.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/measure/character/evaluated_character.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {

class Command;

// Writes the result of `evaluate` to the report's file, and its rows as a table to the output stream. Before
// the work begins, checks that the report and the folder of pictures can be written, and that no output would
// replace an input. `files` are the files that `evaluate` reads and writes, without the report.
void run_evaluation(const CommonOptions& options, CommandFiles files,
                    const std::function<nlohmann::ordered_json()>& evaluate);

// The two files of a baked character, as arguments of a command.
struct EvaluatedFiles {
  std::filesystem::path character, model;
  bake::ImportOptions reading;
};

void add_evaluated_files(Command command, EvaluatedFiles& files);

// Returns both files as inputs of the command.
std::vector<NamedFile> named_files(const EvaluatedFiles& files);

// Prints the warnings of the import. Throws ToolError (bad input) that names the file if a file cannot be
// read, or if the model belongs to another character.
measure::BakedCharacter read_evaluated_files(const EvaluatedFiles& files, const CommonOptions& options);

}  // namespace nook::tool
