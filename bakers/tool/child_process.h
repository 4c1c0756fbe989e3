// A program that this one starts and waits for.
#pragma once

#include <string>
#include <vector>

namespace nook::tool {

// Starts a program with these arguments; the first is its name. Its output and error streams go to the
// descriptors, where -1 leaves this program's. It has a process group of its own, so that wait_for_child()
// decides how it is stopped. If this program is killed, it is stopped too. Throws ToolError.
int start_child(const char* program, const std::vector<std::string>& arguments, int output, int error);

// Tells the child to stop, if this program was told so and `told` is false; `told` becomes true.
void pass_on_interrupt(int child, bool& told);

// Waits for the end, and passes on the first signal that stops this program. Returns the exit code, and 128
// plus the number of the signal that killed the child, as shells do.
int wait_for_child(int child);

// Returns so many lines from the end of a text.
std::string last_lines(const std::string& text, std::size_t lines);

}  // namespace nook::tool
