// A command line program of subcommands: parses the arguments, runs what they name, and turns failures into a
// line on the error stream and an exit code. `nook` and `nook-lab` are two of them.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace nook::tool {

// `name` and `description` head the help; `add_commands` adds the subcommands. Returns the exit code.
int run_program(int argc, char** argv, const char* name, const char* description,
                const std::function<void(CLI::App&)>& add_commands);

}  // namespace nook::tool
