// Reads and writes whole files. Failures are std::runtime_error with a text that names the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace platform {

std::vector<unsigned char> read_file(const std::filesystem::path& path);
// Creates the folder if necessary. A failed run leaves no half-written file.
void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size);

}  // namespace platform
