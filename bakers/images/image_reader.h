// Opens each image file with only one reader of OpenImageIO. By default, if a reader rejects a file,
// OpenImageIO tries all its other readers, including those for videos and raw photographs. For a damaged
// image, this would take about fifty times as long and would run code that no supported image needs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "platform/image_codec.h"

namespace nook::bake {

// Recognises an image's format from its first bytes. Returns the usual file extension without the dot: png,
// jpg, exr, hdr, tif, bmp or ppm. Returns null for other formats.
const char* image_format_of(std::span<const std::byte> head);

// Opens an image. The first bytes of the file determine the format. If they do not, as for TGA, the file's
// extension does. If the image cannot be opened, returns null and sets `why` to the reason.
std::unique_ptr<platform::ImageSource> open_image(const std::filesystem::path& path,
                                                  platform::ImageAlpha alpha, std::string& why);

}  // namespace nook::bake
