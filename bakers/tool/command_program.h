// A command line program with subcommands. Parses the arguments and runs the command that they name. Converts
// failures to a line on the error stream and an exit code. Both `nook` and `nook-lab` use this code.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nook::tool {

// Commands and options that belong to another program. If a user tries them here, a message names that
// program.
struct ElsewhereWords {
  std::string program, how_to_get;  // texts for the message
  // The key is the command of this program under which users may look for the words, such as "evaluate nnao".
  // The word "*" stands for all arguments without dashes.
  std::map<std::string, std::vector<std::string>> words;
};

// `name` and `description` are shown at the top of the help. `add_commands` adds the subcommands. Returns the
// exit code. Call it first in main().
int run_program(int argc, char** argv, const char* name, const char* description,
                const std::function<void(CLI::App&)>& add_commands, const ElsewhereWords& elsewhere = {});

}  // namespace nook::tool
