// Opens each image file with one reader of OpenImageIO. If a reader refuses a file, OpenImageIO itself would
// try all its other readers, including the readers of videos and raw photographs. A damaged image would take
// some fifty times as long, and reach code that no image needs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "platform/image_codec.h"

namespace nook::bake {

// Recognises an image's format from its first bytes. Returns the usual ending of its names without a dot:
// png, jpg, exr, hdr, tif, bmp or ppm; null for others.
const char* image_format_of(std::span<const std::byte> head);

// Opens an image by its first bytes, whatever its name is. If they tell nothing, as in a TGA, the ending of
// its name decides. Returns null if it cannot be opened; `why` is then the reason.
std::unique_ptr<platform::ImageSource> open_image(const std::filesystem::path& path,
                                                  platform::ImageAlpha alpha, std::string& why);

}  // namespace nook::bake
