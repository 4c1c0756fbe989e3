// Starts the program again with the instruction set of --isa in its environment. The C library chooses the
// paths of its mathematics when a process starts, so that a running process cannot pin them.
#pragma once

namespace nook::tool {

// Call it first in main(). It returns if the arguments name no instruction set, or the environment has it
// already; also if the program cannot be started again, which run_bake() then reports.
void pin_process(int argc, char** argv);

}  // namespace nook::tool
