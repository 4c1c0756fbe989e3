// Starts the program again with the instruction set of --isa in its environment. This is necessary because
// the C library chooses the code paths of its math functions when a process starts. A running process cannot
// change them.
#pragma once

#include <string>
#include <vector>

namespace nook::tool {

// Call it first in main(). The function returns if the arguments do not name an instruction set, or if the
// environment already contains the named one. It also returns if the program cannot be started again. In that
// case, run_bake() reports the failure. `nook plan` and `nook build` pin themselves to x86-64-v3 if nothing
// names another one.
void pin_process(int argc, char** argv);

// Sets the environment so that programs that this one starts are pinned and need not start themselves again.
// `words` are the arguments of a bake after the program's name.
void pin_children(const std::vector<std::string>& words);

// Returns the instruction set that pin_process() found, or "native" if none is pinned.
std::string pinned_isa();

}  // namespace nook::tool
