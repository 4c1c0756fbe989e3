#include "bakers/images/texture_file.h"

#include <OpenImageIO/filesystem.h>

#include <string>
#include <string_view>

#include "bakers/images/image_reader.h"
#include "bakers/images/image_size.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t most_texels = std::size_t{1} << 26;

// Null for what glTF does not allow.
const char* format_of(const std::vector<std::byte>& bytes) {
  const char* format = image_format_of(bytes);
  return format && (format == "png"sv || format == "jpg"sv) ? format : nullptr;
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
  std::string why;
  const auto input = open_image_in_memory(format, config, why);
  if (!input)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s cannot be decoded (%s)", image.name.c_str(), why.c_str());
  const OIIO::ImageSpec spec = input->spec();
  check_image_size(image.name.c_str(), spec.width, spec.height, most_texels, image.bytes.size());
  if (spec.nchannels < 1) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no channels", image.name.c_str());
  const std::size_t texels = std::size_t(spec.width) * std::size_t(spec.height);
  const auto channels = std::size_t(std::min(spec.nchannels, 4));
  std::vector<std::uint8_t> read(channels * texels);
  if (!read_pixels(*input, int(channels), OIIO::TypeDesc::UINT8, read.data()))
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
