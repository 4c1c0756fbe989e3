// Lists the images of a folder, and checks an image before a library takes memory for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace nook::bake {

// Returns sorted paths. Both functions throw Failure(NOOK_ERROR_BAD_FILE) if the folder cannot be read.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);
std::vector<std::filesystem::path> images_below(const std::filesystem::path& folder);

// Throws Failure(NOOK_ERROR_BAD_FILE) if an image has no texels, more than max_texels, or more than a file of
// this many bytes can hold. `what` begins the message.
void check_image_size(const char* what, int width, int height, std::size_t max_texels,
                      std::uintmax_t file_bytes);

// Checks an EXR file's head before a library reads it. OpenEXR takes the memory that an attribute claims, up
// to 2 GB, before it looks whether the file has as much.

// Throws Failure(NOOK_ERROR_BAD_FILE) if `path` begins like an EXR file and its head is false. An attribute
// may be longer than the rest of the file, or have another size than its type. The head may declare more rows
// than the file has places for. `what` begins the message. A file of another kind, or one that cannot be
// opened, passes: its reader names the fault.
void check_exr_head(const char* what, const std::filesystem::path& path);

}  // namespace nook::bake
