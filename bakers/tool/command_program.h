// A command line program with subcommands. It parses the arguments, runs what they name, and turns failures
// into a line on the error stream and an exit code. `nook` and `nook-lab` use it.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nook::tool {

// Commands and options that belong to another program, for users who look for them here.
struct ElsewhereWords {
  std::string program, how_to_get;  // names in the message
  // By the command here under which users may look for them, such as "evaluate nnao"; "*" means arguments
  // without dashes.
  std::map<std::string, std::vector<std::string>> words;
};

// `name` and `description` head the help; `add_commands` adds the subcommands. Returns the exit code. Call it
// first in main().
int run_program(int argc, char** argv, const char* name, const char* description,
                const std::function<void(CLI::App&)>& add_commands, const ElsewhereWords& elsewhere = {});

}  // namespace nook::tool
