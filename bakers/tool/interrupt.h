// Ctrl-C as a flag that long work checks between its steps.
#pragma once

namespace nook::tool {

// The first SIGINT, SIGTERM or SIGHUP sets the flag, a second one ends the process at once. A signal that was
// ignored when the program began stays ignored.
void watch_for_interrupt();
bool interrupted();

}  // namespace nook::tool
