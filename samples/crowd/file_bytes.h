// Whole files in and out. Failures are std::runtime_error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace crowd {

std::vector<unsigned char> read_file(const std::filesystem::path& path);
// A failed run leaves no half file. Makes the folder.
void write_file(const std::filesystem::path& path, const void* bytes, std::size_t size);
// FNV-1a of 64 bits: names a cached file after what it was made from.
std::uint64_t hash_bytes(const void* bytes, std::size_t size);

}  // namespace crowd
