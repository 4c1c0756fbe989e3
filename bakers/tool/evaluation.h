// The frame of every evaluation. It runs on the requested threads and writes a report. Also reads the files
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

// Writes what evaluate returns to the report's file, and its rows as a table to the output stream. Checks
// before the work begins that the report and the folder of pictures can be written, and that none would
// replace a file that is read. files: what evaluate reads and writes, without the report.
void run_evaluation(const CommonOptions& options, CommandFiles files,
                    const std::function<nlohmann::ordered_json()>& evaluate);

// The two files of a baked character are arguments of a command.
struct EvaluatedFiles {
  std::filesystem::path character, model;
  bake::ImportOptions reading;
};

void add_evaluated_files(Command command, EvaluatedFiles& files);

// Returns both as inputs of the command.
std::vector<NamedFile> named_files(const EvaluatedFiles& files);

// Prints the character's warnings. Throws ToolError (bad input) that names the file, if it cannot be read or
// is the model of another character.
measure::BakedCharacter read_evaluated_files(const EvaluatedFiles& files, const CommonOptions& options);

}  // namespace nook::tool
