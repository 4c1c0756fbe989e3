// The output stream of a program. A result that does not get out is an error.
#pragma once

#include <string_view>

namespace platform {

// False if the program was started without an output stream; see standard_streams.h.
bool has_output_stream();

// Writes and flushes. Throws std::runtime_error if the text does not get out, as on a full disk.
void print(std::string_view text);

// Throws std::runtime_error if something printed by other means did not get out.
void require_printed();

}  // namespace platform
