// The check of an image's size before memory is taken for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::bake {

// Throws Failure(NOOK_ERROR_BAD_FILE) where an image has no texels, more than max_texels, or more than a file
// of so many bytes can hold: its head then says more than is there. `what` begins the message.
void check_image_size(const char* what, int width, int height, std::size_t max_texels,
                      std::uintmax_t file_bytes);

}  // namespace nook::bake
