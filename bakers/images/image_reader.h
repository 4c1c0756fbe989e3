// Opens each image file with one reader of OpenImageIO. If a reader refuses a file, OpenImageIO itself would
// try all its other readers, including the readers of videos and raw photographs. A damaged image would take
// some fifty times as long, and reach code that no image needs.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace nook::bake {

// Recognises an image's format from its first bytes. Returns the usual ending of its names without a dot:
// png, jpg, exr, hdr, tif, bmp or ppm; null for others.
const char* image_format_of(std::span<const std::byte> head);

// Opens an image by its first bytes, whatever its name is. If they tell nothing, as in a TGA, the ending of
// its name decides. Returns null if it cannot be opened; `why` is then the reason.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path, const OIIO::ImageSpec& config,
                                             std::string& why);

// The same for an image in memory, whose format is known; `config` names its OIIO::Filesystem::IOProxy.
std::unique_ptr<OIIO::ImageInput> open_image_in_memory(const char* format, const OIIO::ImageSpec& config,
                                                       std::string& why);

// Reads the first channels of the rows from `top` to before `bottom` of an image without tiles, as `type`.
// Rows count as in the image's spec. Returns false if they cannot be read. OpenImageIO converts through a
// buffer of 64 MiB, however small an image is. So we read rows in the file's own type and convert afterwards.
bool read_rows(OIIO::ImageInput& image, int top, int bottom, int channels, OIIO::TypeDesc type, void* values);

// Reads all rows, also of images with tiles.
bool read_pixels(OIIO::ImageInput& image, int channels, OIIO::TypeDesc type, void* values);

}  // namespace nook::bake
