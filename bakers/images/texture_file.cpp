#include "bakers/images/texture_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <string>

#include "bakers/images/image_size.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

constexpr std::size_t most_texels = std::size_t{1} << 26;

// OpenImageIO chooses the format by the name, which images of glTF may lack.
const char* format_of(const std::vector<std::byte>& bytes) {
  const auto starts = [&](std::initializer_list<unsigned> magic) {
    std::size_t i = 0;
    for (const unsigned m : magic)
      if (i >= bytes.size() || std::to_integer<unsigned>(bytes[i++]) != m) return false;
    return true;
  };
  if (starts({0x89, 'P', 'N', 'G'})) return "texture.png";
  if (starts({0xff, 0xd8, 0xff})) return "texture.jpg";
  return nullptr;
}

}  // namespace

Texture decode_texture(const EncodedImage& image) {
  const char* format = format_of(image.bytes);
  if (!format)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s is neither PNG nor JPEG; convert it", image.name.c_str());
  OIIO::Filesystem::IOMemReader reader(image.bytes.data(), image.bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &reader;
  // The reader is passed in the configuration; OpenImageIO 2.4 loses a reader that is passed beside one.
  OIIO::ImageSpec config;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  config["oiio:UnassociatedAlpha"] = 1;
  const auto input = OIIO::ImageInput::open(format, &config);
  if (!input)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s cannot be decoded (%s)", image.name.c_str(),
                  OIIO::geterror().c_str());
  const OIIO::ImageSpec spec = input->spec();
  check_image_size(image.name.c_str(), spec.width, spec.height, most_texels, image.bytes.size());
  if (spec.nchannels < 1) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no channels", image.name.c_str());
  const std::size_t texels = std::size_t(spec.width) * std::size_t(spec.height);
  const auto channels = std::size_t(std::min(spec.nchannels, 4));
  std::vector<std::uint8_t> read(channels * texels);
  if (!input->read_image(0, 0, 0, int(channels), OIIO::TypeDesc::UINT8, read.data()))
    throw Failure(NOOK_ERROR_BAD_FILE, "%s is a damaged image (%s)", image.name.c_str(),
                  input->geterror().c_str());
  const bool grey = channels < 3;
  std::vector<std::uint8_t> rgba(4 * texels, 255);
  for (std::size_t i = 0; i < texels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgba[4 * i + c] = read[channels * i + (grey ? 0 : c)];
    if (channels % 2 == 0) rgba[4 * i + 3] = read[channels * i + channels - 1];
  }
  return Texture(std::uint32_t(spec.width), std::uint32_t(spec.height), std::move(rgba));
}

}  // namespace nook::bake
