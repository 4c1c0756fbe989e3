// Lists the images of a folder, and checks an image before a library allocates memory for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace nook::bake {

// Both functions return sorted paths. images_below also searches subfolders. They throw
// Failure(NOOK_ERROR_BAD_FILE) if the folder cannot be read.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);
std::vector<std::filesystem::path> images_below(const std::filesystem::path& folder);

// Throws Failure(NOOK_ERROR_BAD_FILE) if an image has no texels, more than max_texels, or more than fit into
// a file of file_bytes bytes. The message begins with `what`.
void check_image_size(const char* what, int width, int height, std::size_t max_texels,
                      std::uintmax_t file_bytes);

// Checks the header of an EXR file before a library reads it. OpenEXR allocates the size that an attribute
// declares, up to 2 GB, before it finds out that the file is shorter.

// Throws Failure(NOOK_ERROR_BAD_FILE) if `path` begins like an EXR file but its header is invalid. A header
// is invalid if an attribute is longer than the rest of the file, or if its size does not match its type. It
// is also invalid if it declares more rows than the file can contain. The message begins with `what`. Files
// of other formats and files that cannot be opened pass this check. Their reader reports the error.
void check_exr_head(const char* what, const std::filesystem::path& path);

}  // namespace nook::bake
