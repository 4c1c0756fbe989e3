// Makes text from files and arguments safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace platform {

// Replaces control characters (C0, DEL and C1), characters that change the writing direction, and invalid
// UTF-8 by visible escapes such as \x1b. A name then cannot colour, move or retitle a terminal.
std::string printable(std::string_view text);

// The same for text of several lines; line feeds stay.
std::string printable_lines(std::string_view text);

}  // namespace platform
