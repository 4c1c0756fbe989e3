// The output stream of a program, where a lost result is a failure.
#pragma once

#include <string_view>

namespace platform {

// False where the program was started without an output stream; see standard_streams.h.
bool has_output_stream();

// Writes and flushes. Throws std::runtime_error where the text does not get out, as on a full disk.
void print(std::string_view text);

// Throws std::runtime_error if something that was printed by other means did not get out.
void require_printed();

}  // namespace platform
