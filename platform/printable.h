// Makes text from files and arguments safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace platform {

// Replaces control characters (C0, DEL and C1), characters that change the writing direction, and invalid
// UTF-8 with visible escapes such as \x1b. So the name of a file cannot change the colours, the cursor or the
// title of a terminal.
std::string printable(std::string_view text);

// Like printable(), for text with several lines. Keeps line feeds.
std::string printable_lines(std::string_view text);

}  // namespace platform
