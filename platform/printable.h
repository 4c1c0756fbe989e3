// Text from files and arguments, made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace platform {

// Control characters (C0, DEL and C1), characters that turn the direction of writing, and bytes that are no
// UTF-8 become visible escapes such as \x1b: a name cannot colour, move or retitle a terminal.
std::string printable(std::string_view text);

// The same for text of several lines, whose line feeds stay.
std::string printable_lines(std::string_view text);

}  // namespace platform
