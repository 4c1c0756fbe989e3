// Ctrl-C as a flag that long work asks for between its steps.
#pragma once

namespace nook::tool {

// The first SIGINT or SIGTERM sets the flag, a second one ends the process at once.
void watch_for_interrupt();
bool interrupted();

}  // namespace nook::tool
