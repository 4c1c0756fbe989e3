#include "bakers/images/image_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>
#include <vector>

namespace nook::bake {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  const char* format;
};

constexpr std::array magics{Magic{"\x89PNG"sv, "png"},
                            Magic{"\xff\xd8\xff"sv, "jpg"},
                            Magic{"\x76\x2f\x31\x01"sv, "exr"},
                            Magic{"#?RADIANCE"sv, "hdr"},
                            Magic{"#?RGBE"sv, "hdr"},
                            Magic{"II*\0"sv, "tif"},
                            Magic{"MM\0*"sv, "tif"},
                            Magic{"BM"sv, "bmp"}};
constexpr std::size_t longest_magic = 10;

// Netpbm bitmaps: P1 to P6, and the two kinds with floats.
constexpr std::string_view netpbm_kinds = "123456fF";

// Formats that a name's ending can select.
constexpr std::array endings{"png"sv, "jpg"sv, "jpeg"sv, "exr"sv, "hdr"sv, "tif"sv, "tiff"sv,
                             "bmp"sv, "ppm"sv, "pgm"sv,  "pbm"sv, "pfm"sv, "tga"sv};

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return std::find(endings.begin(), endings.end(), ending) == endings.end() ? std::string() : ending;
}

std::unique_ptr<OIIO::ImageInput> open_as(const std::string& format, const std::string& name,
                                          const OIIO::ImageSpec& config, std::string& why) {
  // Given the name of a format, OpenImageIO makes a reader and opens nothing.
  auto input = OIIO::ImageInput::create(format);
  if (!input) {
    why = OIIO::geterror();
    return nullptr;
  }
  OIIO::ImageSpec opened;
  if (input->open(name, opened, config)) return input;
  why = input->geterror();
  return nullptr;
}

}  // namespace

const char* image_format_of(std::span<const std::byte> head) {
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  for (const Magic& magic : magics)
    if (text.starts_with(magic.bytes)) return magic.format;
  const bool is_netpbm =
      text.size() >= 2 && text[0] == 'P' && netpbm_kinds.find(text[1]) != std::string_view::npos;
  return is_netpbm ? "ppm" : nullptr;
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path, const OIIO::ImageSpec& config,
                                             std::string& why) {
  std::array<char, longest_magic> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  if (file.bad() || (file.fail() && !file.eof())) {
    why = "the file cannot be opened";
    return nullptr;
  }
  const char* told = image_format_of(std::as_bytes(std::span(head).first(std::size_t(file.gcount()))));
  const std::string format = told ? told : ending_of(path);
  if (format.empty()) {
    why = "it is neither PNG, JPEG, HDR, EXR, TIFF, BMP, PPM nor TGA";
    return nullptr;
  }
  return open_as(format, path.string(), config, why);
}

std::unique_ptr<OIIO::ImageInput> open_image_in_memory(const char* format, const OIIO::ImageSpec& config,
                                                       std::string& why) {
  return open_as(format, std::string("image.") + format, config, why);
}

bool read_rows(OIIO::ImageInput& image, int top, int bottom, int channels, OIIO::TypeDesc type,
               void* values) {
  const OIIO::ImageSpec& spec = image.spec();
  // The image has no single type if its channels have several.
  if (!spec.channelformats.empty())
    return image.read_scanlines(0, 0, top, bottom, spec.z, 0, channels, type, values);
  const std::size_t count = std::size_t(channels) * std::size_t(spec.width) * std::size_t(bottom - top);
  std::vector<std::byte> own(count * spec.format.size());
  return image.read_scanlines(0, 0, top, bottom, spec.z, 0, channels, OIIO::TypeDesc::UNKNOWN, own.data()) &&
         OIIO::convert_pixel_values(spec.format, own.data(), type, values, int(count));
}

bool read_pixels(OIIO::ImageInput& image, int channels, OIIO::TypeDesc type, void* values) {
  const OIIO::ImageSpec& spec = image.spec();
  if (spec.tile_width != 0) return image.read_image(0, 0, 0, channels, type, values);
  return read_rows(image, spec.y, spec.y + spec.height, channels, type, values);
}

}  // namespace nook::bake
