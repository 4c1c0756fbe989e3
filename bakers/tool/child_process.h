// Starts another program and waits for it.
#pragma once

#include <string>
#include <vector>

namespace nook::tool {

// Starts a program and returns its process id. The first argument is the program's name. The output and error
// streams of the child are connected to the descriptors `output` and `error`. If a descriptor is -1, the
// child uses the stream of this program. The child has its own process group, so that only wait_for_child()
// passes signals on to it. If this program is killed, the child is stopped too. Throws ToolError.
int start_child(const char* program, const std::vector<std::string>& arguments, int output, int error);

// If the user has asked this program to stop, and `told` is false, tells the child to stop and sets `told` to
// true.
void pass_on_interrupt(int child, bool& told);

// Waits until the child ends. If a signal asks this program to stop, passes the first such signal on to the
// child. Returns the child's exit code. If a signal killed the child, returns 128 plus the number of the
// signal, as shells do.
int wait_for_child(int child);

// Returns the last `lines` lines of a text.
std::string last_lines(const std::string& text, std::size_t lines);

}  // namespace nook::tool
