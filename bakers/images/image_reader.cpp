#include "bakers/images/image_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>

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

// Netpbm images: P1 to P6, and the float formats Pf and PF.
constexpr std::string_view netpbm_kinds = "123456fF";

// The formats that a file's extension can select.
constexpr std::array endings{"png"sv, "jpg"sv, "jpeg"sv, "exr"sv, "hdr"sv, "tif"sv, "tiff"sv,
                             "bmp"sv, "ppm"sv, "pgm"sv,  "pbm"sv, "pfm"sv, "tga"sv};

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return std::find(endings.begin(), endings.end(), ending) == endings.end() ? std::string() : ending;
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

std::unique_ptr<platform::ImageSource> open_image(const std::filesystem::path& path,
                                                  platform::ImageAlpha alpha, std::string& why) {
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
  return platform::image_codec().open(format, path.string(), alpha, why);
}

}  // namespace nook::bake
