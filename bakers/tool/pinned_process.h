// Starts the program again with the instruction set of --isa in its environment. The C library chooses the
// paths of its mathematics when a process starts, so that a running process cannot pin them.
#pragma once

#include <string>
#include <vector>

namespace nook::tool {

// Call it first in main(). It returns if the arguments name no instruction set, or the environment has it
// already; also if the program cannot be started again, which run_bake() then reports. `nook plan` and
// `nook build` pin themselves to x86-64-v3 if nothing names another one.
void pin_process(int argc, char** argv);

// Pins the programs that this one starts, for the words of a bake behind the program's name. They need not
// start themselves again.
void pin_children(const std::vector<std::string>& words);

// Returns the instruction set that pin_process() found: native if none is pinned.
std::string pinned_isa();

}  // namespace nook::tool
