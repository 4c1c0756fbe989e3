// The two files of a baked character, as arguments of a command.
#pragma once

#include <filesystem>
#include <vector>

#include "bakers/measure/character/baked_character.h"
#include "bakers/tool/distinct_files.h"

namespace CLI {
class App;
}

namespace nook::tool {

void add_evaluated_files(CLI::App& command, std::filesystem::path& character, std::filesystem::path& model);

// As inputs of the command.
std::vector<NamedFile> evaluated_files(const std::filesystem::path& character,
                                       const std::filesystem::path& model);

// Throws ToolError (bad input) that names the file: one that cannot be read, or a model of another character.
measure::BakedCharacter read_evaluated_files(const std::filesystem::path& character,
                                             const std::filesystem::path& model);

}  // namespace nook::tool
