// Starts another program and waits for it.
#pragma once

#include <string>
#include <vector>

namespace nook::tool {

// Starts a program with these arguments; the first is its name. Its output and error streams are connected to
// the given descriptors. With -1, it uses the streams of this program. The child has its own process group,
// so that wait_for_child() decides how it is stopped. If this program is killed, the child is stopped too.
// Throws ToolError.
int start_child(const char* program, const std::vector<std::string>& arguments, int output, int error);

// If this program was told to stop and `told` is false, tells the child to stop and sets `told` to true.
void pass_on_interrupt(int child, bool& told);

// Waits until the child ends. Passes on the first signal that stops this program. Returns the child's exit
// code. If a signal killed the child, returns 128 plus the number of the signal, as shells do.
int wait_for_child(int child);

// Returns the last `lines` lines of a text.
std::string last_lines(const std::string& text, std::size_t lines);

}  // namespace nook::tool
