// The two files of a baked character, as arguments of a command.
#pragma once

#include <filesystem>
#include <vector>

#include "bakers/import/linked_files.h"
#include "bakers/measure/character/evaluated_character.h"
#include "bakers/tool/distinct_files.h"

namespace nook::tool {

class Command;

struct EvaluatedFiles {
  std::filesystem::path character, model;
  bake::LinkedFiles linked = bake::LinkedFiles::folder;
};

void add_evaluated_files(Command command, EvaluatedFiles& files);

// Returns both as inputs of the command.
std::vector<NamedFile> named_files(const EvaluatedFiles& files);

// Throws ToolError (bad input) that names the file: one that cannot be read, or a model of another character.
measure::BakedCharacter read_evaluated_files(const EvaluatedFiles& files);

}  // namespace nook::tool
