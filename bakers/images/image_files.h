// The images of a folder, and checks of an image before a library takes memory for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace nook::bake {

// The images of a folder, by the endings of their names.

// Sorted by path. Both throw Failure(NOOK_ERROR_BAD_FILE) where the folder cannot be read.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);
std::vector<std::filesystem::path> images_below(const std::filesystem::path& folder);

// The check of an image's size before memory is taken for it.

// Throws Failure(NOOK_ERROR_BAD_FILE) where an image has no texels, more than max_texels, or more than a file
// of so many bytes can hold: its head then says more than is there. `what` begins the message.
void check_image_size(const char* what, int width, int height, std::size_t max_texels,
                      std::uintmax_t file_bytes);

// The check of an EXR file's head before a library reads it: OpenEXR takes the memory that an attribute
// claims, up to 2 GB, before it looks whether the file has as much.

// Throws Failure(NOOK_ERROR_BAD_FILE) where `path` begins like an EXR file and an attribute of its heads is
// longer than what follows in the file or of another size than its type, or where it says more rows than the
// file has places for; `what` begins the message. A file of another kind, or one that cannot
// be opened, passes: its reader names the fault.
void check_exr_head(const char* what, const std::filesystem::path& path);

}  // namespace nook::bake
