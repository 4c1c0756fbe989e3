// The images of a folder, by the endings of their names.
#pragma once

#include <filesystem>
#include <vector>

namespace nook::bake {

// Sorted by path. Both throw Failure(NOOK_ERROR_BAD_FILE) where the folder cannot be read.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);
std::vector<std::filesystem::path> images_below(const std::filesystem::path& folder);

}  // namespace nook::bake
