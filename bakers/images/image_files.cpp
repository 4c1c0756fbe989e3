#include "bakers/images/image_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& path) {
  static const std::set<std::string> endings{".png",  ".jpg", ".jpeg", ".exr", ".tif",
                                             ".tiff", ".bmp", ".hdr",  ".ppm", ".tga"};
  std::string ending = path.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  return endings.count(ending) != 0;
}

template <class Iterator>
std::vector<fs::path> images_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (Iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file() && is_image(at->path())) found.push_back(at->path());
  if (error)
    throw Failure(NOOK_ERROR_BAD_FILE, "%.300s: cannot be read (%s)", folder.c_str(),
                  error.message().c_str());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<fs::path> images_in(const fs::path& folder) {
  return images_of<fs::directory_iterator>(folder);
}

std::vector<fs::path> images_below(const fs::path& folder) {
  return images_of<fs::recursive_directory_iterator>(folder);
}

void check_image_size(const char* what, int width, int height, std::size_t max_texels,
                      std::uintmax_t file_bytes) {
  // The limit is above what any format can store in a byte. Deflate reaches at most 1032 bytes, which are
  // 8256 one-bit texels. A JPEG needs at least one bit for a block of 64 texels. An EXR file reaches at most
  // 11,000 texels of one colour.
  constexpr std::uintmax_t max_texels_per_byte = std::uintmax_t{1} << 14;
  if (width < 1 || height < 1 || std::size_t(width) > max_texels / std::size_t(height))
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%.250s has %d x %d texels (need 1 to %zu texels in all); make it smaller", what, width,
                  height, max_texels);
  const std::uintmax_t texels = std::uintmax_t(width) * std::uintmax_t(height);
  if (texels / max_texels_per_byte > file_bytes)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%.250s says that it has %d x %d texels, too many for its %ju bytes; it is damaged", what,
                  width, height, file_bytes);
}

namespace {

constexpr std::uint32_t exr_magic = 20000630;
constexpr std::uint32_t is_tiled = 0x200, is_multipart = 0x1000;  // bits of the version field
// When OpenEXR opens a file, it allocates up to 256 whole rows.
constexpr std::int64_t max_columns = 1 << 16;
constexpr std::size_t max_name_length = 255;  // bytes of an attribute's name or of its type's name

// Reads a little-endian number; all numbers of the format are little-endian. Returns 0 beyond the end of the
// file.
std::uint32_t read_u32(std::istream& file) {
  unsigned char bytes[4] = {};
  file.read(reinterpret_cast<char*>(bytes), 4);
  return file ? std::uint32_t(bytes[0]) | std::uint32_t(bytes[1]) << 8 | std::uint32_t(bytes[2]) << 16 |
                    std::uint32_t(bytes[3]) << 24
              : 0;
}

// Reads a name up to its zero byte. Truncates names that are longer than the format allows; OpenEXR rejects
// such files.
std::string read_name(std::istream& file) {
  std::string name;
  for (char c = 0; name.size() <= max_name_length && file.get(c) && c != 0;) name.push_back(c);
  return name;
}

// Types with a fixed size in bytes. OpenEXR reads this many bytes and ignores the size that the attribute
// declares.
struct FixedType {
  std::string_view name;
  std::uint32_t size;
};
constexpr std::array fixed_types{
    FixedType{"box2f", 16},   FixedType{"box2i", 16},      FixedType{"chromaticities", 32},
    FixedType{"double", 8},   FixedType{"compression", 1}, FixedType{"deepImageState", 1},
    FixedType{"envmap", 1},   FixedType{"float", 4},       FixedType{"int", 4},
    FixedType{"keycode", 28}, FixedType{"lineOrder", 1},   FixedType{"m33d", 72},
    FixedType{"m33f", 36},    FixedType{"m44d", 128},      FixedType{"m44f", 64},
    FixedType{"rational", 8}, FixedType{"tiledesc", 9},    FixedType{"timecode", 8},
    FixedType{"v2d", 16},     FixedType{"v2f", 8},         FixedType{"v2i", 8},
    FixedType{"v3d", 24},     FixedType{"v3f", 12},        FixedType{"v3i", 12}};

// Returns the number of bytes that OpenEXR reads for a value of this type at the file's position. `said` is
// the size that the attribute declares, which OpenEXR uses only for types without a fixed size.
std::uint64_t value_size(std::istream& file, const std::string& type, std::uint32_t said) {
  for (const FixedType& fixed : fixed_types)
    if (type == fixed.name) return fixed.size;
  if (type == "preview") {
    const std::uint64_t width = read_u32(file), height = read_u32(file);
    return height == 0 || width < (std::uint64_t{1} << 32) / height ? 8 + 4 * width * height : UINT64_MAX;
  }
  if (type != "chlist") return said;
  const auto at = file.tellg();
  while (!read_name(file).empty()) file.seekg(16, std::ios::cur);
  return file ? std::uint64_t(file.tellg() - at) : UINT64_MAX;
}

// Skips an attribute whose name has already been read.
void skip_attribute(std::istream& file, const std::string& name, std::uintmax_t file_bytes,
                    const char* what) {
  const std::string type = read_name(file);
  const std::uint32_t size = read_u32(file);
  if (!file) return;
  const auto at = std::uintmax_t(file.tellg());
  if (size > file_bytes - at)
    throw Failure(
        NOOK_ERROR_BAD_FILE,
        "%.250s is a damaged EXR file: its attribute \"%.60s\" should have %u bytes, but only %ju follow",
        what, name.c_str(), size, file_bytes - at);
  // If the sizes differ, OpenEXR continues at another position than this function, and interprets the bytes
  // there as a size.
  if (value_size(file, type, size) != size)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%.250s is a damaged EXR file: its attribute \"%.60s\" has %u bytes, "
                  "which is not the size of the type \"%.60s\"",
                  what, name.c_str(), size, type.c_str());
  file.clear();
  file.seekg(std::streamoff(at + size));
}

// Checks the rows and columns that an attribute with the image's extent declares. The attribute's name has
// already been read. A scanline file stores an 8-byte offset for each block of at most 256 rows, so the file
// size limits the number of rows.
void check_extent(std::istream& file, std::uint32_t version, std::uintmax_t file_bytes, const char* what) {
  const auto at = file.tellg();
  read_name(file);  // its type
  std::int64_t edge[5] = {};
  for (std::int64_t& value : edge)
    value = std::int32_t(read_u32(file));  // its size, left, top, right, bottom
  const std::int64_t rows = edge[4] - edge[2] + 1;
  if (file && (version & is_tiled) == 0 && rows > 0 && std::uintmax_t(rows) / 32 > file_bytes)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "%.250s is a damaged EXR file: it says that it has %lld rows, too many for its %ju bytes",
                  what, static_cast<long long>(rows), file_bytes);
  const std::int64_t columns = edge[3] - edge[1] + 1;
  if (file && columns > max_columns)
    throw Failure(NOOK_ERROR_BAD_FILE, "%.250s has %lld columns (need at most %lld); make it smaller", what,
                  static_cast<long long>(columns), static_cast<long long>(max_columns));
  file.clear();
  file.seekg(at);
}

}  // namespace

void check_exr_head(const char* what, const std::filesystem::path& path) {
  std::error_code unknown;
  const std::uintmax_t file_bytes = std::filesystem::file_size(path, unknown);
  std::ifstream file(path, std::ios::binary);
  if (unknown || read_u32(file) != exr_magic) return;
  const std::uint32_t version = read_u32(file);
  // An empty name ends a header. If a file has several parts, an empty header ends the list of headers.
  for (bool head_is_empty = true; file;) {
    const std::string name = read_name(file);
    if (!file || (name.empty() && (head_is_empty || (version & is_multipart) == 0))) return;
    head_is_empty = name.empty();
    if (name == "dataWindow") check_extent(file, version, file_bytes, what);
    if (!head_is_empty) skip_attribute(file, name, file_bytes, what);
  }
}

}  // namespace nook::bake
