// Reads and writes whole files. On failure, throws std::runtime_error with a text that contains the name of
// the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace platform {

std::vector<unsigned char> read_file(const std::filesystem::path& path);
// Creates the folder if necessary. If writing fails, no half-written file remains.
void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size);

}  // namespace platform
