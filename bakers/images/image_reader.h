// Opens image files by one reader of OpenImageIO. OpenImageIO itself gives a file that a reader refuses to
// every other one that it has, those of videos and of raw photographs included: a damaged image takes some
// fifty times as long, and meets code that no image needs.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace nook::bake {

// Returns the ending of the format's names, without a dot, that an image's first bytes tell: png, jpg, exr,
// hdr, tif, bmp or ppm; null for others.
const char* image_format_of(std::span<const std::byte> head);

// Opens an image by its first bytes, whatever its name is; by the ending of its name where they tell nothing,
// as those of TGA. Returns null where it cannot be opened; `why` is the reason then.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path, const OIIO::ImageSpec& config,
                                             std::string& why);

// The same for an image in memory, whose format is known; `config` names its OIIO::Filesystem::IOProxy.
std::unique_ptr<OIIO::ImageInput> open_image_in_memory(const char* format, const OIIO::ImageSpec& config,
                                                       std::string& why);

// Reads the first channels of rows from `top` to before `bottom` of an image that has no tiles, as `type`;
// rows count as those of the image's spec. Returns false where they cannot be read. OpenImageIO converts
// through a buffer of 64 MiB, however small an image is; here rows are read in the file's own type, and
// converted then.
bool read_rows(OIIO::ImageInput& image, int top, int bottom, int channels, OIIO::TypeDesc type, void* values);

// The same for all rows, of images with tiles as well.
bool read_pixels(OIIO::ImageInput& image, int channels, OIIO::TypeDesc type, void* values);

}  // namespace nook::bake
