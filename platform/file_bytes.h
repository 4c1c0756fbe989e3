// Whole files in and out. Failures are std::runtime_error with a text that names the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace platform {

std::vector<unsigned char> read_file(const std::filesystem::path& path);
// A failed run leaves no half-written file. Makes the folder.
void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size);

}  // namespace platform
