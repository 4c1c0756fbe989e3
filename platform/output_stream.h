// Writes to the output stream of a program. It is an error if a result cannot be written completely.
#pragma once

#include <string_view>

namespace platform {

// Returns false if the program was started without an output stream; see standard_streams.h.
bool has_output_stream();

// Writes and flushes a text. Throws std::runtime_error if this fails, for example on a full disk.
void print(std::string_view text);

// Throws std::runtime_error if earlier output that was printed by other functions could not be written.
void require_printed();

}  // namespace platform
